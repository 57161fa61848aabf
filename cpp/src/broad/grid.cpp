// SPDX-License-Identifier: Apache-2.0
#include "carom/broad/grid.hpp"

#include <bit>
#include <string>

#include "carom/numerics/invalid_input.hpp"

#include "broad/cell_table.hpp"
#include "broad/face_store.hpp"
#include "broad/pair_keys.hpp"

namespace carom {

using namespace broad;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr int most_cells = 1 << 20;  // along an axis: three indices fit one key
// Faces are listed in every cell they reach within this share of a cell, which exceeds the rounding
// of a walk as long as it begins within 2^22 cells: 8 units of roundoff of 2^22 cells are 2^-28.
constexpr double rim = 0x1p-26;
constexpr double longest_walk = 0x1p22;
// The automatic size, measured on meshes of even and of mixed faces (study "trees").
constexpr double cells_per_face = 1.5;
constexpr double entries_per_face = 12;

}  // namespace

struct HashGrid::Impl {
  TriangleMesh mesh;
  std::vector<Box> boxes;
  double lower[3] = {0, 0, 0}, size = 1, inverse = 1;
  Cell last{0, 0, 0};  // of the grid; the first is 0, 0, 0
  CellTable table;

  // Monotone in x whatever the rounding, so boxes that overlap share a cell.
  [[nodiscard]] int cell_along(double x, int k) const {
    const double c = std::floor((x - lower[k]) * inverse);
    return static_cast<int>(larger(-1, smaller(c, static_cast<double>(last[k]) + 1)));
  }
  [[nodiscard]] int clamped(double x, int k) const {
    return std::min(std::max(cell_along(x, k), 0), last[k]);
  }

  void cells_of(int face, Cell& first, Cell& end) const {
    const Box& box = boxes[static_cast<std::size_t>(face)];
    for (int k = 0; k < 3; ++k) {
      first[k] = clamped(box[static_cast<std::size_t>(k)] - rim * size, k);
      end[k] = clamped(box[static_cast<std::size_t>(k) + 3] + rim * size, k);
    }
  }

  [[nodiscard]] double entries_at(double h) const {
    double sum = 0;
    for (const Box& box : boxes) {
      double cells = 1;
      for (std::size_t k = 0; k < 3; ++k) cells *= (box[3 + k] - box[k]) / h + 1;
      sum += cells;
    }
    return sum;
  }

  double extent() const {
    double most = 0;
    for (int k = 0; k < 3; ++k) most = larger(most, upper_[k] - lower[k]);
    return most;
  }
  double upper_[3] = {0, 0, 0};

  [[nodiscard]] double automatic_size() const {
    double sum = 0;
    for (const Box& box : boxes)
      sum += std::max({box[3] - box[0], box[4] - box[1], box[5] - box[2]});
    const double whole = extent();
    if (!(whole > 0)) return 1;
    double h = cells_per_face * sum / static_cast<double>(boxes.size());
    h = std::max(h, whole / 1024);
    while (entries_at(h) > entries_per_face * static_cast<double>(boxes.size()) + 64) h *= 1.25;
    return h;
  }

  void build(std::optional<double> wanted) {
    const int n = static_cast<int>(mesh.faces.rows());
    boxes.resize(static_cast<std::size_t>(n));
    for (int k = 0; k < 3; ++k) lower[k] = n == 0 ? 0 : inf, upper_[k] = n == 0 ? 0 : -inf;
    for (int f = 0; f < n; ++f) {
      const Box box = boxes[static_cast<std::size_t>(f)] = box_of(mesh, f);
      for (std::size_t k = 0; k < 3; ++k) {
        lower[k] = smaller(lower[k], box[k]);
        upper_[k] = larger(upper_[k], box[3 + k]);
      }
    }
    size = wanted.value_or(n == 0 ? 1 : automatic_size());
    require_positive(size, "cell_size", "m");
    require_finite(size, "cell_size", "m");
    const double along = extent() / size;
    if (!(along < most_cells - 2))
      throw InvalidInput("cell_size", with_unit(size, "m"),
                         "must leave fewer than 2^20 cells along an axis; the mesh is " +
                             with_unit(extent(), "m") + " long",
                         "use larger cells, or a Bvh");
    if (n > 0 && !(entries_at(size) < 0x1p31))
      throw InvalidInput("cell_size", with_unit(size, "m"), "must need fewer than 2^31 entries",
                         "use larger cells, or a Bvh");
    inverse = 1 / size;
    last = {most_cells, most_cells, most_cells};
    for (int k = 0; k < 3; ++k) last[k] = std::max(cell_along(upper_[k], k), 0);

    table.reserve(static_cast<std::size_t>(n));
    Cell first, end;
    for (int f = 0; f < n; ++f) {
      cells_of(f, first, end);
      for_cells(first, end, [&](const Cell& c) { table.count(c); });
    }
    table.finish_counting();
    for (int f = 0; f < n; ++f) {
      cells_of(f, first, end);
      for_cells(first, end, [&](const Cell& c) { table.put(c, f); });
    }
    table.finish();
  }

  template <class Visit>
  static void for_cells(const Cell& first, const Cell& end, Visit visit) {
    Cell c;
    for (c[2] = first[2]; c[2] <= end[2]; ++c[2])
      for (c[1] = first[1]; c[1] <= end[1]; ++c[1])
        for (c[0] = first[0]; c[0] <= end[0]; ++c[0]) visit(c);
  }

  // Visits the faces of each cell the ray crosses, in order; stops once `done(t)` at the parameter
  // where it leaves a cell. The intervals of consecutive cells join, so no part is skipped.
  template <class Visit, class Done>
  void walk(const Ray& ray, Visit visit, Done done) const {
    if (boxes.empty()) return;
    double enter = 0, leave = ray.t_max;
    for (int k = 0; k < 3; ++k) {
      const double low = lower[k] - rim * size;
      const double high = lower[k] + (last[k] + 1 + rim) * size;
      if (ray.step[k] == 0) {
        if (ray.start[k] < low || ray.start[k] > high) return;
        continue;
      }
      const double a = (low - ray.start[k]) / ray.step[k], b = (high - ray.start[k]) / ray.step[k];
      enter = larger(enter, smaller(a, b));
      leave = smaller(leave, larger(a, b));
    }
    const double reach = enter + extent();
    if (!(reach < longest_walk * size)) {
      // The walk's rounding could exceed the rim: look at every face instead.
      for (int f = 0; f < static_cast<int>(boxes.size()); ++f) visit(f);
      return;
    }
    if (!(enter <= leave + rim * size)) return;
    Cell cell;
    double next[3];
    int towards[3];
    const auto boundary = [&](int k) {
      if (ray.step[k] == 0) return inf;
      const double plane = lower[k] + (cell[k] + (ray.step[k] > 0 ? 1 : 0)) * size;
      return (plane - ray.start[k]) / ray.step[k];
    };
    for (int k = 0; k < 3; ++k) {
      cell[k] = clamped(ray.start[k] + enter * ray.step[k], k);
      towards[k] = ray.step[k] > 0 ? 1 : -1;
    }
    for (int k = 0; k < 3; ++k) next[k] = boundary(k);
    while (true) {
      for (const int face : table.faces(cell)) visit(face);
      const int k = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
      if (done(next[k]) || next[k] > leave) return;
      cell[k] += towards[k];
      if (cell[k] < 0 || cell[k] > last[k]) return;
      next[k] = boundary(k);
    }
  }

  [[nodiscard]] Nearest first_hit(const Ray& ray) const {
    Nearest best{ray.t_max, -1};
    walk(
        ray, [&](int face) { consider_hit(mesh, face, ray, best); },
        [&](double t) { return best.face >= 0 && best.t < t; });
    return best;
  }
  [[nodiscard]] std::uint8_t hits_any(const Ray& ray) const {
    Nearest best{ray.t_max, -1};
    walk(
        ray,
        [&](int face) {
          if (best.face < 0) consider_hit(mesh, face, ray, best);
        },
        [&](double) { return best.face >= 0; });
    return best.face >= 0;
  }

  void all_in(const double* box, std::vector<int>& faces) const {
    if (boxes.empty()) return;
    Cell first, end;
    double cells = 1;
    for (int k = 0; k < 3; ++k) {
      if (cell_along(box[k], k) > last[k] || cell_along(box[3 + k], k) < 0) return;
      first[k] = clamped(box[k], k);
      end[k] = clamped(box[3 + k], k);
      cells *= end[k] - first[k] + 1;
    }
    if (cells > static_cast<double>(boxes.size())) {
      for (int f = 0; f < static_cast<int>(boxes.size()); ++f)
        if (boxes_meet(boxes[static_cast<std::size_t>(f)].data(), box)) faces.push_back(f);
      return;
    }
    for_cells(first, end, [&](const Cell& c) {
      for (const int f : table.faces(c)) {
        if (!boxes_meet(boxes[static_cast<std::size_t>(f)].data(), box)) continue;
        // Named in the first cell that both share, so once.
        Cell own, own_end;
        cells_of(f, own, own_end);
        if (std::max(own[0], first[0]) == c[0] && std::max(own[1], first[1]) == c[1] &&
            std::max(own[2], first[2]) == c[2])
          faces.push_back(f);
      }
    });
  }

  // Cubes of cells around the point, one ring at a time.
  void nearest(const double* point, Nearest& best, double* at) const {
    if (boxes.empty()) return;
    Cell centre;
    double outside = 0;
    for (int k = 0; k < 3; ++k) {
      centre[k] = clamped(point[k], k);
      outside = larger(outside, larger(lower[k] - point[k], point[k] - upper_[k]));
    }
    double visited = 0;
    for (int ring = 0;; ++ring) {
      Cell first, end;
      double reached = inf;
      for (int k = 0; k < 3; ++k) {
        first[k] = std::max(centre[k] - ring, 0);
        end[k] = std::min(centre[k] + ring, last[k]);
        // Beyond the cube nothing is nearer than its faces that lie inside the grid.
        if (first[k] > 0)
          reached = smaller(reached, point[k] - (lower[k] + (first[k] + rim) * size));
        if (end[k] < last[k])
          reached = smaller(reached, lower[k] + (end[k] + 1 - rim) * size - point[k]);
      }
      visited += 24.0 * ring * ring + 2;
      // Far from everything, rings cost more than looking at each face; so would rounding tell.
      if (visited > static_cast<double>(boxes.size()) + 4096 || !(outside < longest_walk * size)) {
        for (int f = 0; f < static_cast<int>(boxes.size()); ++f)
          consider_point(mesh, f, point, best, at);
        return;
      }
      for_cells(first, end, [&](const Cell& c) {
        int off = 0;
        for (int k = 0; k < 3; ++k) off = std::max(off, std::abs(c[k] - centre[k]));
        if (off != ring) return;
        for (const int f : table.faces(c)) consider_point(mesh, f, point, best, at);
      });
      if (reached == inf) return;
      if (best.face >= 0 && reached > 0 && best.t < reached * reached) return;
    }
  }

  void all_self_pairs(std::vector<std::uint64_t>& keys) const {
    table.for_each([&](const Cell& c, std::span<const int> faces) {
      for (std::size_t i = 0; i < faces.size(); ++i) {
        Cell one, one_end;
        cells_of(faces[i], one, one_end);
        for (std::size_t j = i + 1; j < faces.size(); ++j) {
          if (!boxes_meet(boxes[static_cast<std::size_t>(faces[i])].data(),
                          boxes[static_cast<std::size_t>(faces[j])].data()))
            continue;
          Cell two, two_end;
          cells_of(faces[j], two, two_end);
          if (std::max(one[0], two[0]) == c[0] && std::max(one[1], two[1]) == c[1] &&
              std::max(one[2], two[2]) == c[2])
            keys.push_back(pair_key(faces[i], faces[j]));
        }
      }
    });
  }
};

HashGrid::HashGrid(const Eigen::Ref<const TriangleMesh::Vertices>& vertices,
                   const Eigen::Ref<const TriangleMesh::Faces>& faces,
                   std::optional<double> cell_size)
    : impl_(std::make_unique<Impl>()) {
  require_mesh(vertices, faces);
  impl_->mesh = {vertices, faces};
  impl_->build(cell_size);
}
HashGrid::~HashGrid() = default;
HashGrid::HashGrid(HashGrid&&) noexcept = default;
HashGrid& HashGrid::operator=(HashGrid&&) noexcept = default;

std::vector<RayHit> HashGrid::raycast(Points origins, Points directions,
                                      double max_distance) const {
  return each_ray(origins, directions, max_distance,
                  one_by_one<Nearest>([&](const Ray& ray) { return impl_->first_hit(ray); }));
}
std::vector<std::uint8_t> HashGrid::any_hit(Points origins, Points directions,
                                            double max_distance) const {
  return each_any(origins, directions, max_distance,
                  one_by_one<std::uint8_t>([&](const Ray& ray) { return impl_->hits_any(ray); }));
}
std::vector<SegmentHit> HashGrid::segments(Points starts, Points ends) const {
  return each_segment(starts, ends,
                      one_by_one<Nearest>([&](const Ray& ray) { return impl_->first_hit(ray); }));
}
std::vector<std::uint8_t> HashGrid::blocked(Points starts, Points ends) const {
  return each_blocked(
      starts, ends, one_by_one<std::uint8_t>([&](const Ray& ray) { return impl_->hits_any(ray); }));
}
Overlaps HashGrid::overlaps(Points lower, Points upper) const {
  return each_box(lower, upper,
                  [&](const double* box, std::vector<int>& faces) { impl_->all_in(box, faces); });
}
std::vector<ClosestPoint> HashGrid::closest(Points points) const {
  return each_point(points, [&](const double* point, Nearest& best, double* at) {
    impl_->nearest(point, best, at);
  });
}
std::vector<BodyPair> HashGrid::self_pairs() const {
  std::vector<std::uint64_t> keys;
  impl_->all_self_pairs(keys);
  return sorted_pairs(std::move(keys), face_count());
}
int HashGrid::face_count() const {
  return static_cast<int>(impl_->mesh.faces.rows());
}
std::size_t HashGrid::memory_bytes() const {
  return impl_->table.memory_bytes() + sizeof(Box) * impl_->boxes.size() +
         sizeof(double) * static_cast<std::size_t>(impl_->mesh.vertices.size()) +
         sizeof(int) * static_cast<std::size_t>(impl_->mesh.faces.size());
}
double HashGrid::cell_size() const {
  return impl_->size;
}
std::size_t HashGrid::cell_count() const {
  return impl_->table.cells();
}
std::size_t HashGrid::entry_count() const {
  return impl_->table.entries();
}

}  // namespace carom
