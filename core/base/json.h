#pragma once

#include <nlohmann/json.hpp>

// What can be is compiled once, in json.cpp, and not with each file that reads or writes JSON.
extern template class nlohmann::basic_json<>;
