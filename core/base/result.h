#pragma once

#include <string>
#include <utility>

#include <tl/expected.hpp>

namespace arris {

/// What went wrong, as one sentence a user can act on: which file, which line or element, what was
/// expected.
struct Error {
  std::string message;
  /// True when the user stopped the work; not a fault.
  bool cancelled = false;
  /// True when there was nothing to do: everything is as the operation would leave it. A recipe
  /// goes on.
  bool nothing_to_do = false;
};

/// A value or an Error. Errors are values: nothing in core/ throws across its public functions.
template <class T>
using Result = tl::expected<T, Error>;

/// `return fail("...")` from any function that returns a Result.
inline tl::unexpected<Error> fail(std::string message) {
  return tl::unexpected<Error>(Error{std::move(message)});
}

/// The same where the operation would change nothing.
inline tl::unexpected<Error> nothing_to_do(std::string message) {
  return tl::unexpected<Error>(Error{std::move(message), false, true});
}

inline tl::unexpected<Error> cancelled() {
  return tl::unexpected<Error>(Error{"The work was cancelled.", true, false});
}

}  // namespace arris
