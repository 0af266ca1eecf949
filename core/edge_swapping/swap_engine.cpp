#include "core/edge_swapping/swap_engine.h"

#include <algorithm>

#include "core/simplification/simplify.h"

namespace arris {

namespace {

/// Cosine of 120 degrees: a smaller one between neighbours is a flip.
constexpr double flip_cosine = -0.5;

/// True where the angles at p of the two faces beside the edge from p to q, with apexes r and s,
/// add up to less than pi, so that the unfolded quadrangle is convex there.
bool is_convex(const Point& p, const Point& q, const Point& r, const Point& s) {
  const Point along = q - p, u = r - p, w = s - p;
  const double sine_u = along.cross(u).norm(), cosine_u = along.dot(u);
  const double sine_w = along.cross(w).norm(), cosine_w = along.dot(w);
  return sine_u * cosine_w + cosine_u * sine_w > 1e-12 * along.squaredNorm() * u.norm() * w.norm();
}

bool is_degenerate(const Point& a, const Point& b, const Point& c) {
  const Point ab = b - a, ac = c - a;
  return WorkingMesh::is_degenerate(ab.cross(ac).norm(), ab, ac, c - b);
}

}  // namespace

SwapEngine::SwapEngine(WorkingMesh& mesh, Cost cost, bool wide)
    : mesh_(mesh), cost_(cost), wide_(wide), queued_(4 * mesh.face_slots(), 0) {}

void SwapEngine::enqueue(SideId side) {
  const SideId twin = mesh_.twin(side);
  if (twin == no_id) return;
  side = std::min(side, twin);
  if (queued_[side]) return;
  queued_[side] = 1;
  queue_.push_back(side);
}

Result<std::uint64_t> SwapEngine::run(const SwapOptions& options, const Context& context) {
  const FaceId faces = static_cast<FaceId>(mesh_.face_slots());
  std::uint64_t swaps = 0, before_sweep = 0;
  double sweep_start = 0.0;
  do {
    before_sweep = swaps;
    for (FaceId f = 0; f < faces; ++f) {
      if ((f & 0xFFF) == 0) {
        if (context.cancelled()) return cancelled();
        const double share = static_cast<double>(f) / static_cast<double>(faces);
        context.report(sweep_start + (1.0 - sweep_start) * 0.7 * share, "swaps");
      }
      for (SideId k = 0; k < 3; ++k) {
        const SideId side = 4 * f + k;
        if (mesh_.twin(side) == no_id || mesh_.twin(side) < side) continue;
        swaps += try_swap(side, options);
        for (std::size_t next = 0; next < queue_.size(); ++next) {
          queued_[queue_[next]] = 0;
          swaps += try_swap(queue_[next], options);
          if ((next & 0xFFF) == 0xFFF && context.cancelled()) return cancelled();
        }
        queue_.clear();
      }
    }
    sweep_start += 0.7 * (1.0 - sweep_start);
  } while (swaps != before_sweep);
  return swaps;
}

bool SwapEngine::try_swap(SideId side, const SwapOptions& options) {
  SideId twin = mesh_.twin(side);
  if (twin == no_id || mesh_.is_sharp(side)) return false;
  SwapCase s;
  if (mesh_.from(side) > mesh_.from(twin)) std::swap(side, twin);
  s.a = mesh_.from(side);
  s.b = mesh_.from(twin);
  s.left = side >> 2;
  s.right = twin >> 2;
  s.bc = WorkingMesh::next(side);
  s.ca = WorkingMesh::next(s.bc);
  s.ad = WorkingMesh::next(twin);
  s.db = WorkingMesh::next(s.ad);
  s.c = mesh_.from(s.ca);
  s.d = mesh_.from(s.db);
  if (s.c == s.d) return false;
  const Point &a = mesh_.point(s.a), &b = mesh_.point(s.b);
  const Point &c = mesh_.point(s.c), &d = mesh_.point(s.d);
  if (!is_convex(a, b, c, d) || !is_convex(b, a, d, c)) return false;
  s.new_left = mesh_.normal_of(s.a, s.d, s.c);
  s.new_right = mesh_.normal_of(s.d, s.b, s.c);
  const Values values = cost_(mesh_, s);
  if (!values.better || is_degenerate(a, d, c) || is_degenerate(d, b, c) ||
      mesh_.has_edge(s.c, s.d) || is_flip(s) || !zones_fit(s))
    return false;
  swap(s);
  if (options.observe) options.observe(values.before, values.after);
  return true;
}

bool SwapEngine::is_flip(const SwapCase& s) const {
  const Point &left = mesh_.normal(s.left), &right = mesh_.normal(s.right);
  double before = std::min(flip_cosine, left.dot(right));
  double after = s.new_left.dot(s.new_right);
  const auto beyond = [&](SideId side, const Point& old_normal, const Point& new_normal) {
    const SideId twin = mesh_.twin(side);
    if (twin == no_id) return;
    const Point& normal = mesh_.normal(twin >> 2);
    before = std::min(before, normal.dot(old_normal));
    after = std::min(after, normal.dot(new_normal));
  };
  beyond(s.ad, right, s.new_left);
  beyond(s.db, right, s.new_right);
  beyond(s.bc, left, s.new_right);
  beyond(s.ca, left, s.new_left);
  return after < before;
}

bool SwapEngine::zones_fit(const SwapCase& s) {
  zones_.clear();
  answering_.clear();
  std::array<TriangleQuery, 2> queries;
  queries[0].set(mesh_.point(s.a), mesh_.point(s.d), mesh_.point(s.c), s.new_left);
  queries[1].set(mesh_.point(s.d), mesh_.point(s.b), mesh_.point(s.c), s.new_right);
  for (const FaceId f : {s.left, s.right})
    for (VertexId v = mesh_.face(f).first_zone; v != no_id; v = mesh_.next_zone(v)) {
      const Point& p = mesh_.point(v);
      const double radius2 = mesh_.squared_radius(v);
      std::uint8_t k = 0;
      if (!queries[0].is_over(p, radius2)) {
        k = 1;
        if (!queries[1].is_over(p, radius2)) {
          const double first = queries[0].squared_distance(p);
          const double second = queries[1].squared_distance(p);
          k = first <= second ? 0 : 1;
          if (std::min(first, second) > radius2) return false;
        }
      }
      zones_.push_back(v);
      answering_.push_back(k);
    }
  return true;
}

void SwapEngine::swap(const SwapCase& s) {
  struct Outer {
    SideId side, twin;
    bool sharp;
  };
  const auto outer = [&](SideId side) {
    return Outer{side, mesh_.twin(side), mesh_.is_sharp(side)};
  };
  const std::array<Outer, 4> old{outer(s.ad), outer(s.db), outer(s.bc), outer(s.ca)};
  mesh_.set_face(s.left, s.a, s.d, s.c, s.new_left);
  mesh_.set_face(s.right, s.d, s.b, s.c, s.new_right);
  const SideId l = 4 * s.left, r = 4 * s.right;
  const std::array<SideId, 4> moved{l, r, r + 1, l + 2};  // ad, db, bc, ca
  for (int k = 0; k < 4; ++k) {
    mesh_.link(moved[k], old[k].twin);
    if (old[k].sharp) mesh_.set_sharp(moved[k]);
  }
  mesh_.link(l + 1, r + 2);
  for (const SideId face : {l, r})
    for (SideId k = 0; k < 3; ++k) mesh_.update_first_side(face + k);
  for (std::size_t i = 0; i < zones_.size(); ++i)
    mesh_.add_zone(answering_[i] == 0 ? s.left : s.right, zones_[i]);
  for (const SideId side : moved) {
    enqueue(side);
    const SideId twin = mesh_.twin(side);
    if (!wide_ || twin == no_id) continue;
    enqueue(WorkingMesh::next(twin));
    enqueue(WorkingMesh::previous(twin));
  }
}

Result<Prepared> run_swaps(const Mesh& mesh, const ErrorZonesPtr& zones,
                           const ChunkedArray<Origin>& sharp, SwapEngine::Cost cost, bool wide,
                           const SwapOptions& options, const Context& context, const char* phase) {
  if (!sharp.empty() && sharp.size() != mesh.edge_count())
    return fail("The sharp edges belong to another mesh: find them again.");
  context.report(0.0, phase);
  const Result<ErrorZonesPtr> known = zones_or_start(mesh, zones);
  if (!known) return tl::unexpected(known.error());
  WorkingMesh working(mesh, **known, sharp);
  SwapEngine engine(working, cost, wide);
  const Result<std::uint64_t> swaps = engine.run(options, context.part(0.1, 0.9));
  if (!swaps) return tl::unexpected(swaps.error());
  Result<Prepared> result = working.finish();
  if (result) result->swaps = *swaps;
  context.report(1.0, phase);
  return result;
}

}  // namespace arris
