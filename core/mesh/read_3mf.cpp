#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <expat.h>
#include <zip.h>
#include <Eigen/LU>

#include "core/mesh/gunzip.h"
#include "core/mesh/readers.h"
#include "core/mesh/text_scanner.h"

namespace arris {

namespace {

/// A point p of an object goes to M p + t.
struct Placement {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Point shift = Point::Zero();

  Placement then(const Placement& outer) const {
    return {outer.turn * turn, outer.turn * shift + outer.shift};
  }
};

/// Objects are numbered within one part (file) of the package.
using ObjectId = std::pair<std::string, std::int64_t>;

struct Instance {
  ObjectId object;
  Placement placement;
};

struct Object {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  std::vector<Instance> components;
};

struct Model {
  std::map<ObjectId, Object> objects;
  std::vector<Instance> items;  ///< What the build of the first part asks for.
  std::string unit = "millimeter";
};

/// A ZIP archive in memory.
class Archive {
 public:
  explicit Archive(const FileBytes& file) : file_(file) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* const source =
        zip_source_buffer_create(file.bytes.data(), file.bytes.size(), 0, &error);
    if (source) {
      zip_.reset(zip_open_from_source(source, ZIP_RDONLY, &error));
      if (!zip_) zip_source_free(source);
    }
    zip_error_fini(&error);
  }

  bool is_open() const { return zip_ != nullptr; }
  zip_int64_t count() const { return zip_get_num_entries(zip_.get(), 0); }
  std::string name(zip_int64_t index) const {
    const char* const text = zip_get_name(zip_.get(), static_cast<zip_uint64_t>(index), 0);
    return text ? text : "";
  }
  zip_int64_t find(const std::string& name) const {
    return zip_name_locate(zip_.get(), name.c_str(), ZIP_FL_NOCASE);
  }

  /// Hands the content on in blocks until `take` returns false.
  template <class Take>
  Result<void> read(zip_int64_t index, const Context& context, const Take& take) const {
    struct Close {
      void operator()(zip_file_t* f) const { zip_fclose(f); }
    };
    const std::unique_ptr<zip_file_t, Close> part(
        zip_fopen_index(zip_.get(), static_cast<zip_uint64_t>(index), 0));
    const std::string where = file_.path + " (" + name(index) + ")";
    if (!part) return fail(where + " cannot be unpacked: it is encrypted or damaged.");
    constexpr std::size_t block = std::size_t{1} << 16;
    const auto buffer = std::make_unique_for_overwrite<char[]>(block);
    const std::size_t most = most_growth(file_.bytes.size());
    std::size_t sum = 0;
    while (true) {
      if (context.cancelled()) return cancelled();
      const zip_int64_t size = zip_fread(part.get(), buffer.get(), block);
      if (size < 0) return fail(where + " is damaged: it cannot be unpacked.");
      sum += static_cast<std::size_t>(size);
      if (sum > most)
        return fail(where + " unpacks to more than 200 times its size; it is no mesh file.");
      if (!take(std::string_view(buffer.get(), static_cast<std::size_t>(size)), size == 0) ||
          size == 0)
        return {};
    }
  }

 private:
  struct Discard {
    void operator()(zip_t* z) const { zip_discard(z); }
  };
  const FileBytes& file_;
  std::unique_ptr<zip_t, Discard> zip_;
};

/// The path of a part as the archive has it, for a target as the package names it.
std::string part_name(std::string_view target) {
  while (target.starts_with('/')) target.remove_prefix(1);
  return std::string(target);
}

/// Attributes of one element.
class Attributes {
 public:
  explicit Attributes(const XML_Char** list) : list_(list) {}
  /// By name, whatever its namespace; null where absent.
  const char* find(std::string_view name) const {
    for (const XML_Char** at = list_; *at; at += 2) {
      const char* const bar = std::strrchr(at[0], '|');
      if (name == (bar ? bar + 1 : at[0])) return at[1];
    }
    return nullptr;
  }

 private:
  const XML_Char** list_;
};

/// Reads one XML part. Nothing is thrown through the parser, which is C.
class XmlReader {
 public:
  virtual ~XmlReader() = default;

  Result<void> read(const Archive& archive, zip_int64_t index, const FileBytes& file,
                    const Context& context) {
    where_ = file.path + " (" + archive.name(index) + ")";
    struct Free {
      void operator()(XML_Parser p) const { XML_ParserFree(p); }
    };
    const std::unique_ptr<XML_ParserStruct, Free> parser(XML_ParserCreateNS(nullptr, '|'));
    if (!parser) throw std::bad_alloc();
    parser_ = parser.get();
    XML_SetUserData(parser_, this);
    XML_SetElementHandler(parser_, on_start, on_end);
    XML_SetStartDoctypeDeclHandler(
        parser_, [](void* self, const XML_Char*, const XML_Char*, const XML_Char*, int) {
          static_cast<XmlReader*>(self)->stop("declares a document type, which no 3MF file may.");
        });
    const Result<void> done = archive.read(index, context, [&](std::string_view block, bool last) {
      const XML_Status status =
          XML_Parse(parser_, block.data(), static_cast<int>(block.size()), last);
      if (status == XML_STATUS_OK) return true;
      if (XML_GetErrorCode(parser_) == XML_ERROR_NO_MEMORY) no_memory_ = true;
      if (!error_)
        stop(std::string("is no valid XML: ") + XML_ErrorString(XML_GetErrorCode(parser_)) + ".");
      return false;
    });
    parser_ = nullptr;
    if (no_memory_) throw std::bad_alloc();
    if (!done) return done;
    if (error_) return tl::unexpected(*error_);
    return {};
  }

 protected:
  /// `name` is without its namespace; called for the elements of those that is_mine().
  virtual void start(std::string_view name, const Attributes& attributes) = 0;
  virtual void end(std::string_view) {}
  virtual bool is_mine(std::string_view space) const = 0;

  void stop(const std::string& what) {
    if (!error_)
      error_ = Error{
          where_ + ", line " + std::to_string(XML_GetCurrentLineNumber(parser_)) + ", " + what,
          false};
    XML_StopParser(parser_, XML_FALSE);
  }

 private:
  template <class Work>
  void handle(const XML_Char* full, const Work& work) {
    if (error_ || no_memory_) return;
    const char* const bar = std::strrchr(full, '|');
    if (!is_mine(bar ? std::string_view(full, bar) : std::string_view())) return;
    try {
      work(bar ? bar + 1 : full);
    } catch (const std::bad_alloc&) {
      no_memory_ = true;
      XML_StopParser(parser_, XML_FALSE);
    }
  }
  static void on_start(void* self, const XML_Char* name, const XML_Char** list) {
    auto* const reader = static_cast<XmlReader*>(self);
    reader->handle(name, [&](const char* local) { reader->start(local, Attributes(list)); });
  }
  static void on_end(void* self, const XML_Char* name) {
    auto* const reader = static_cast<XmlReader*>(self);
    reader->handle(name, [&](const char* local) { reader->end(local); });
  }

  XML_Parser parser_ = nullptr;
  std::string where_;
  std::optional<Error> error_;
  bool no_memory_ = false;
};

/// Finds the part that holds the model: _rels/.rels.
class RelationsReader : public XmlReader {
 public:
  std::string target;

 private:
  bool is_mine(std::string_view) const override { return true; }
  void start(std::string_view name, const Attributes& attributes) override {
    if (name != "Relationship") return;
    const char* const type = attributes.find("Type");
    const char* const to = attributes.find("Target");
    if (type && to && std::string_view(type).ends_with("/3dmodel")) target = part_name(to);
  }
};

class ModelReader : public XmlReader {
 public:
  ModelReader(std::string part, Model& model, bool is_first)
      : part_(std::move(part)), model_(model), is_first_(is_first) {}

 private:
  bool is_mine(std::string_view space) const override {
    return space.empty() || space.find("/3dmanufacturing/core/") != std::string_view::npos;
  }

  void start(std::string_view name, const Attributes& attributes) override {
    if (name == "vertex") {
      if (object_) add_vertex(attributes);
    } else if (name == "triangle") {
      if (object_) add_triangle(attributes);
    } else if (name == "object") {
      const std::optional<std::int64_t> id = whole(attributes, "id");
      if (!id) return stop("an object has no number \"id\".");
      const auto [at, fresh] = model_.objects.try_emplace({part_, *id});
      if (!fresh) return stop("the object " + std::to_string(*id) + " is there twice.");
      object_ = &at->second;
      id_ = *id;
    } else if (name == "component") {
      if (object_) add_instance(attributes, object_->components);
    } else if (name == "item") {
      if (is_first_) add_instance(attributes, model_.items);
    } else if (name == "model" && is_first_) {
      if (const char* const unit = attributes.find("unit")) model_.unit = unit;
    }
  }

  void end(std::string_view name) override {
    if (name != "object" || !object_) return;
    for (const Triangle& t : object_->triangles)
      for (const VertexId v : t)
        if (v >= object_->points.size())
          return stop("a triangle of object " + std::to_string(id_) + " names vertex " +
                      std::to_string(v) + ", but there are only " +
                      std::to_string(object_->points.size()) + " vertices.");
    object_ = nullptr;
  }

  static std::optional<std::int64_t> whole(const Attributes& attributes, std::string_view name) {
    const char* const text = attributes.find(name);
    return text ? parse_integer(text) : std::nullopt;
  }

  void add_vertex(const Attributes& attributes) {
    Point point;
    constexpr std::string_view axes[] = {"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
      const char* const text = attributes.find(axes[axis]);
      const std::optional<double> value = text ? parse_number(text) : std::nullopt;
      if (!value)
        return stop("expected a coordinate \"" + std::string(axes[axis]) + "\", " +
                    (text ? found_instead(text) : "found none."));
      point[axis] = *value;
    }
    object_->points.push_back(point);
  }

  void add_triangle(const Attributes& attributes) {
    Triangle triangle;
    constexpr std::string_view names[] = {"v1", "v2", "v3"};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::optional<std::int64_t> v = whole(attributes, names[k]);
      if (!v || *v < 0 || static_cast<std::uint64_t>(*v) > most_elements)
        return stop("a triangle has no vertex number \"" + std::string(names[k]) + "\".");
      triangle[k] = static_cast<VertexId>(*v);
    }
    object_->triangles.push_back(triangle);
  }

  void add_instance(const Attributes& attributes, std::vector<Instance>& list) {
    const std::optional<std::int64_t> id = whole(attributes, "objectid");
    if (!id) return stop("a component or item names no object.");
    Instance instance;
    // An object of another part, as the production extension has it.
    const char* const part = attributes.find("path");
    instance.object = {part ? part_name(part) : part_, *id};
    if (const char* const text = attributes.find("transform")) {
      // Rows of the matrix by which a row vector is multiplied from the right.
      TextScanner words(text, {});
      for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 3; ++column) {
          const std::optional<double> value = parse_number(words.word());
          if (!value) return stop("a \"transform\" needs twelve numbers.");
          (row < 3 ? instance.placement.turn(column, row) : instance.placement.shift[column]) =
              *value;
        }
    }
    list.push_back(std::move(instance));
  }

  std::string part_;
  Model& model_;
  bool is_first_;
  Object* object_ = nullptr;
  std::int64_t id_ = 0;
};

/// Puts the objects where the build wants them.
class Assembly {
 public:
  Assembly(const FileBytes& file, const Model& model, PolygonFile& out)
      : file_(file), model_(model), out_(out) {}

  Result<void> run(const std::vector<Instance>& items) {
    // Counted before anything is made: a few components of components can be any number.
    Size sum;
    for (const Instance& item : items) {
      const Result<Size> size = measure(item.object, 0);
      if (!size) return tl::unexpected(size.error());
      sum.add(*size);
    }
    if (sum.elements > most || sum.instances > most)
      return fail(file_.path + " puts together more than " + std::to_string(most) +
                  " triangles and vertices out of copies of its objects.");
    for (const Instance& item : items) place(item.object, item.placement);
    return {};
  }

 private:
  static constexpr std::uint64_t most = 100'000'000;
  struct Size {
    std::uint64_t elements = 0, instances = 0;
    void add(const Size& other) {
      elements = std::min(elements + other.elements, most + 1);
      instances = std::min(instances + other.instances, most + 1);
    }
  };

  Result<Size> measure(const ObjectId& id, int depth) {
    constexpr int deepest = 100;
    const auto found = model_.objects.find(id);
    if (found == model_.objects.end())
      return fail(file_.path + " names object " + std::to_string(id.second) + " of " + id.first +
                  ", which is not there.");
    if (const auto known = sizes_.find(id); known != sizes_.end()) return known->second;
    if (depth > deepest)
      return fail(file_.path + ": object " + std::to_string(id.second) +
                  " is a part of itself, or its components are nested too deep.");
    const Object& object = found->second;
    Size size{object.points.size() + object.triangles.size(), 1};
    for (const Instance& component : object.components) {
      const Result<Size> part = measure(component.object, depth + 1);
      if (!part) return part;
      size.add(*part);
    }
    return sizes_[id] = size;
  }

  void place(const ObjectId& id, const Placement& placement) {
    const Object& object = model_.objects.at(id);
    const VertexId first = static_cast<VertexId>(out_.points.size());
    for (const Point& p : object.points)
      out_.points.push_back(placement.turn * p + placement.shift);
    const bool mirrored = placement.turn.determinant() < 0.0;
    for (const Triangle& t : object.triangles) {
      out_.corners.insert(out_.corners.end(),
                          {first + t[0], first + t[mirrored ? 2 : 1], first + t[mirrored ? 1 : 2]});
      out_.starts.push_back(out_.corners.size());
    }
    for (const Instance& component : object.components)
      place(component.object, component.placement.then(placement));
  }

  const FileBytes& file_;
  const Model& model_;
  PolygonFile& out_;
  std::map<ObjectId, Size> sizes_;
};

}  // namespace

Result<void> read_3mf(const FileBytes& file, PolygonFile& out, const Context& context) {
  out.format = "3MF";
  out.starts.push_back(0);
  const Archive archive(file);
  if (!archive.is_open()) return fail(file.path + " is a ZIP archive that is damaged or cut off.");
  std::string first;
  if (const zip_int64_t index = archive.find("_rels/.rels"); index >= 0) {
    RelationsReader relations;
    if (const Result<void> ok = relations.read(archive, index, file, context); !ok) return ok;
    first = relations.target;
  }
  if (first.empty()) first = "3D/3dmodel.model";
  if (archive.find(first) < 0)
    return fail(file.path +
                " is a ZIP archive without a 3D model, not a mesh file that can be read (STL, PLY, "
                "OBJ, OFF or 3MF): if it holds one, unpack it first.");

  // Parts that components refer to are read in turn, each once.
  Model model;
  std::vector<std::string> parts{first};
  std::set<std::string> known{first};
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const zip_int64_t index = archive.find(parts[k]);
    if (index < 0) continue;  // whoever names an object in it gets an error
    ModelReader reader(parts[k], model, k == 0);
    if (const Result<void> ok = reader.read(archive, index, file, context); !ok) return ok;
    context.report(0.8 * static_cast<double>(k + 1) / static_cast<double>(parts.size()), "reading");
    const auto note = [&](const Instance& instance) {
      if (known.insert(instance.object.first).second) parts.push_back(instance.object.first);
    };
    for (const Instance& item : model.items) note(item);
    for (const auto& [id, object] : model.objects)
      if (id.first == parts[k])
        for (const Instance& component : object.components) note(component);
  }
  out.unit = model.unit;
  if (model.items.empty()) {
    // Some programs leave the build out; then every object that no other holds is meant.
    std::set<ObjectId> held;
    for (const auto& [id, object] : model.objects)
      for (const Instance& component : object.components) held.insert(component.object);
    for (const auto& [id, object] : model.objects)
      if (!held.contains(id)) model.items.push_back({id, {}});
    if (!model.items.empty())
      out.notes.push_back(
          "The file does not say which of its objects are to be built; all were "
          "read where they are.");
  }
  return Assembly(file, model, out).run(model.items);
}

}  // namespace arris
