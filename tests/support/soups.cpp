#include "tests/support/soups.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace arris::testing {

namespace {

class Soup {
 public:
  explicit Soup(Random& random) : random_(random) {}

  Triangles make(SoupKind kind) {
    switch (kind) {
      case SoupKind::cloud:
        cloud();
        break;
      case SoupKind::surface:
        surface();
        break;
      case SoupKind::fans:
        fans();
        break;
      case SoupKind::little:
        little();
        break;
    }
    for (std::uint64_t k = below(5); k > 0; --k) damage();
    scale();
    return std::move(mesh_);
  }

 private:
  std::uint64_t below(std::uint64_t end) { return random_.bits() % end; }
  VertexId vertex() {
    return mesh_.points.empty() ? 0 : static_cast<VertexId>(below(mesh_.points.size()));
  }
  Triangle* face() {
    return mesh_.triangles.empty() ? nullptr : &mesh_.triangles[below(mesh_.triangles.size())];
  }
  Point lattice_point() {
    const auto at = [&] { return static_cast<double>(below(4)); };
    return {at(), at(), at()};
  }

  void cloud() {
    for (std::uint64_t k = 3 + below(20); k > 0; --k) mesh_.points.push_back(lattice_point());
    for (std::uint64_t k = 1 + below(60); k > 0; --k)
      mesh_.triangles.push_back({vertex(), vertex(), vertex()});
  }

  void surface() {
    switch (below(7)) {
      case 0:
        mesh_ = cube(2.0);
        break;
      case 1:
        mesh_ = divided_cube(3.0, 1 + static_cast<int>(below(4)));
        break;
      case 2:
        mesh_ = icosphere(1.0, static_cast<int>(below(3)));
        break;
      case 3:
        mesh_ = torus(3.0, 1.0, 3 + static_cast<int>(below(9)), 3 + static_cast<int>(below(5)));
        break;
      case 4:
        mesh_ =
            cylinder_wall(1.0, 3.0, 3 + static_cast<int>(below(9)), 1 + static_cast<int>(below(5)));
        break;
      case 5:
        mesh_ = random_terrain(3 + static_cast<int>(below(9)), random_.bits());
        break;
      default:
        mesh_ = block_with_holes(static_cast<int>(below(3)));
    }
    if (below(3) == 0) mesh_ = noisy(mesh_, random_.uniform(0.0, 0.8), random_.bits());
  }

  /// Books of pages round an edge, and cones that meet in their tips.
  void fans() {
    mesh_.points = {{0, 0, 0}, {0, 0, 1}};
    for (std::uint64_t k = 2 + below(6); k > 0; --k) {
      mesh_.points.push_back(lattice_point());
      mesh_.triangles.push_back({0, 1, static_cast<VertexId>(mesh_.points.size() - 1)});
    }
    for (std::uint64_t k = below(4); k > 0; --k) {
      const auto first = static_cast<VertexId>(mesh_.points.size());
      const auto around = static_cast<VertexId>(3 + below(4));
      for (VertexId i = 0; i < around; ++i) {
        const double angle = 6.283185307179586 * i / around;
        mesh_.points.push_back({std::cos(angle), std::sin(angle), static_cast<double>(k) - 2.0});
        mesh_.triangles.push_back({0, first + i, first + (i + 1) % around});
      }
    }
  }

  void little() {
    mesh_.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.5}};
    mesh_.triangles = {{0, 1, 2}, {1, 3, 2}, {0, 2, 3}};
    mesh_.triangles.resize(below(4));
  }

  double odd_number() {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    static constexpr std::array numbers{infinite,
                                        -infinite,
                                        std::numeric_limits<double>::quiet_NaN(),
                                        std::numeric_limits<double>::denorm_min(),
                                        std::numeric_limits<double>::min(),
                                        std::numeric_limits<double>::max(),
                                        -std::numeric_limits<double>::max(),
                                        1e30,
                                        -1e30,
                                        1e-30,
                                        0.0,
                                        -0.0};
    return numbers[below(numbers.size())];
  }

  void damage() {
    Triangle* const f = face();
    if (!f) return;
    switch (below(10)) {
      case 0:  // doubled
        mesh_.triangles.push_back(Triangle(*f));
        break;
      case 1:  // inverted
        std::swap((*f)[0], (*f)[1]);
        break;
      case 2:  // doubled and inverted: both sides of one sheet
        mesh_.triangles.push_back({(*f)[1], (*f)[0], (*f)[2]});
        break;
      case 3:  // left out
        std::swap(*f, mesh_.triangles.back());
        mesh_.triangles.pop_back();
        break;
      case 4:
        (*f)[below(3)] = vertex();
        break;
      case 5:
        (*f)[0] = (*f)[1];
        break;
      case 6: {  // vertices thrown together
        const VertexId from = vertex(), to = vertex();
        for (Triangle& t : mesh_.triangles)
          for (VertexId& v : t)
            if (v == from) v = to;
        break;
      }
      case 7:  // on one place, but not one
        mesh_.points[vertex()] = mesh_.points[vertex()];
        break;
      case 8:
        mesh_.points[vertex()][static_cast<Eigen::Index>(below(3))] = odd_number();
        break;
      default:  // nobody's vertex
        mesh_.points.push_back({random_.uniform(), odd_number(), 0.0});
    }
  }

  void scale() {
    static constexpr std::array sizes{1.0, 1e30, 1e-30, 1e150, 1e-150, 1e308, 1e-308, 1e-310, 1e18};
    const double size = below(2) ? 1.0 : sizes[below(sizes.size())];
    const Point shift = below(5) ? Point::Zero() : Point(Point::Constant(size * 1e8));
    const double flat = below(12) ? 1.0 : 0.0;  // all of it in one plane
    for (Point& p : mesh_.points) {
      p = size * p + shift;
      p.z() *= flat;
    }
  }

  Random& random_;
  Triangles mesh_;
};

}  // namespace

Triangles random_soup(SoupKind kind, Random& random) { return Soup(random).make(kind); }

}  // namespace arris::testing
