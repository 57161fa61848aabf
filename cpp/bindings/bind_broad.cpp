// SPDX-License-Identifier: Apache-2.0
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "carom/broad/all_faces.hpp"
#include "carom/broad/box_tree.hpp"
#include "carom/broad/bvh.hpp"
#include "carom/broad/grid.hpp"
#include "carom/numerics/invalid_input.hpp"

#include "module.hpp"

namespace py = pybind11;
using namespace py::literals;
using namespace carom;

namespace {

using Rows = py::array_t<double, py::array::c_style | py::array::forcecast>;
using FaceRows = py::array_t<int, py::array::c_style | py::array::forcecast>;
using Map = Eigen::Map<const TriangleMesh::Vertices>;
using FaceMap = Eigen::Map<const TriangleMesh::Faces>;

std::string shape_of(const py::array& a) {
  return py::str(py::tuple(a.attr("shape"))).cast<std::string>();
}

Map rows(const Rows& a, const char* name) {
  if (!(a.ndim() == 2 && a.shape(1) == 3) && a.size() != 0)
    throw InvalidInput(name, "shape " + shape_of(a), "must be (N, 3)");
  return {a.data(), a.size() / 3, 3};
}

// Indices as any integer type; what does not fit an int is refused, not wrapped.
FaceRows face_rows(const py::array& a) {
  if (!(a.ndim() == 2 && a.shape(1) == 3) && a.size() != 0)
    throw InvalidInput("faces", "shape " + shape_of(a), "must be (M, 3)");
  const char kind = a.dtype().kind();
  if (a.size() != 0 && kind != 'i' && kind != 'u')
    throw InvalidInput("faces", "dtype " + py::str(a.dtype()).cast<std::string>(),
                       "must be integers");
  if (a.size() != 0 && a.itemsize() > 4) {
    const auto wide = py::array_t < std::int64_t, py::array::c_style | py::array::forcecast > (a);
    for (py::ssize_t i = 0; i < wide.size(); ++i)
      if (wide.data()[i] < 0 || wide.data()[i] > std::numeric_limits<int>::max())
        throw InvalidInput("faces", std::to_string(wide.data()[i]), "must index vertices");
  }
  return FaceRows(a);
}

FaceMap faces_of(const FaceRows& a) {
  return {a.data(), a.size() / 3, 3};
}

// numpy arrays from lists of records, one column at a time.
template <class T, class List, class Get>
py::array_t<T> column(const List& list, Get get) {
  py::array_t<T> out(static_cast<py::ssize_t>(list.size()));
  T* const to = out.mutable_data();
  for (std::size_t i = 0; i < list.size(); ++i) to[i] = get(list[i]);
  return out;
}

py::array_t<bool> flags(const std::vector<std::uint8_t>& list) {
  return column<bool>(list, [](std::uint8_t x) { return x != 0; });
}

py::array_t<int> pair_rows(std::span<const BodyPair> list) {
  py::array_t<int> out({static_cast<py::ssize_t>(list.size()), py::ssize_t{2}});
  for (std::size_t i = 0; i < list.size(); ++i) {
    out.mutable_data()[2 * i] = list[i].a;
    out.mutable_data()[2 * i + 1] = list[i].b;
  }
  return out;
}

template <class F>
auto released(F f) {
  py::gil_scoped_release release;
  return f();
}

template <class Index>
void bind_queries(py::class_<Index>& c) {
  constexpr double far = std::numeric_limits<double>::infinity();
  c.def(
       "raycast",
       [](const Index& index, const Rows& o, const Rows& d, double reach) {
         const Map origins = rows(o, "origins"), directions = rows(d, "directions");
         const auto hits = released([&] { return index.raycast(origins, directions, reach); });
         return py::make_tuple(column<double>(hits, [](const RayHit& h) { return h.distance; }),
                               column<int>(hits, [](const RayHit& h) { return h.face; }));
       },
       "origins"_a, "directions"_a, "max_distance"_a = far,
       "First hit of each ray. origins, directions: (N, 3) m, of any length; max_distance: m, "
       "inclusive.\nReturns distance (N,) m, inf for none, and face (N,), -1 for none.")
      .def(
          "any_hit",
          [](const Index& index, const Rows& o, const Rows& d, double reach) {
            const Map origins = rows(o, "origins"), directions = rows(d, "directions");
            return flags(released([&] { return index.any_hit(origins, directions, reach); }));
          },
          "origins"_a, "directions"_a, "max_distance"_a = far,
          "Whether each ray hits anything: (N,) bool.")
      .def(
          "segments",
          [](const Index& index, const Rows& s, const Rows& e) {
            const Map starts = rows(s, "starts"), ends = rows(e, "ends");
            const auto hits = released([&] { return index.segments(starts, ends); });
            return py::make_tuple(
                column<double>(hits, [](const SegmentHit& h) { return h.fraction; }),
                column<int>(hits, [](const SegmentHit& h) { return h.face; }));
          },
          "starts"_a, "ends"_a,
          "First hit of each closed segment, (N, 3) m.\nReturns the fraction of the way (N,) in "
          "[0, 1], 1 for none, and face (N,), -1 for none.")
      .def(
          "blocked",
          [](const Index& index, const Rows& s, const Rows& e) {
            const Map starts = rows(s, "starts"), ends = rows(e, "ends");
            return flags(released([&] { return index.blocked(starts, ends); }));
          },
          "starts"_a, "ends"_a, "Whether anything lies between start and end: (N,) bool.")
      .def(
          "overlaps",
          [](const Index& index, const Rows& l, const Rows& u) {
            const Map lower = rows(l, "lower"), upper = rows(u, "upper");
            const Overlaps found = released([&] { return index.overlaps(lower, upper); });
            const auto same = [](int x) { return x; };
            return py::make_tuple(column<int>(found.offsets, same), column<int>(found.faces, same));
          },
          "lower"_a, "upper"_a,
          "Faces whose bounding boxes overlap each closed box, (N, 3) m.\nReturns offsets (N + 1,) "
          "and faces: those of box i are faces[offsets[i]:offsets[i + 1]], ascending.")
      .def(
          "closest",
          [](const Index& index, const Rows& p) {
            const Map points = rows(p, "points");
            const auto found = released([&] { return index.closest(points); });
            py::array_t<double> at({static_cast<py::ssize_t>(found.size()), py::ssize_t{3}});
            for (std::size_t i = 0; i < found.size(); ++i)
              for (int k = 0; k < 3; ++k)
                at.mutable_data()[3 * i + static_cast<std::size_t>(k)] = found[i].point[k];
            return py::make_tuple(
                column<double>(
                    found, [](const ClosestPoint& found_point) { return found_point.distance; }),
                column<int>(found,
                            [](const ClosestPoint& found_point) { return found_point.face; }),
                at);
          },
          "points"_a,
          "Nearest point of the mesh to each of (N, 3) points, m.\nReturns distance (N,), face "
          "(N,) and point (N, 3).")
      .def(
          "self_pairs",
          [](const Index& index) {
            return pair_rows(released([&] { return index.self_pairs(); }));
          },
          "Pairs of faces a < b whose bounding boxes overlap, neighbours included: (K, 2), "
          "ascending.")
      .def_property_readonly("face_count", &Index::face_count)
      .def_property_readonly("memory_bytes", &Index::memory_bytes, "bytes held by the index");
}

Volume volume_of(const std::string& name) {
  if (name == "box") return Volume::box;
  if (name == "sphere") return Volume::sphere;
  if (name == "oriented_box") return Volume::oriented_box;
  throw InvalidInput("volume", name, "must be box, sphere or oriented_box");
}

Quality quality_of(const std::string& name) {
  if (name == "low") return Quality::low;
  if (name == "medium") return Quality::medium;
  if (name == "high") return Quality::high;
  throw InvalidInput("quality", name, "must be low, medium or high");
}

std::vector<Aabb> boxes_of(const Map& lower, const Map& upper) {
  if (lower.rows() != upper.rows())
    throw InvalidInput("upper", std::to_string(upper.rows()) + " rows",
                       "must have as many as lower: " + std::to_string(lower.rows()));
  std::vector<Aabb> boxes(static_cast<std::size_t>(lower.rows()));
  for (Eigen::Index i = 0; i < lower.rows(); ++i)
    boxes[static_cast<std::size_t>(i)] = {lower.row(i).transpose(), upper.row(i).transpose()};
  return boxes;
}

}  // namespace

void bind_broad(py::module_& m) {
  py::class_<Bvh> bvh(m, "Bvh",
                      "Bounding volume hierarchy over the faces of a mesh. Answers are those of a "
                      "loop over all faces in double, whatever volume and quality.");
  bvh.def(
      py::init([](const Rows& v, const py::array& f, const std::string& volume,
                  const std::string& quality) {
        const Map vertices = rows(v, "vertices");
        const FaceRows indices = face_rows(f);
        const FaceMap faces = faces_of(indices);
        const Volume kind = volume_of(volume);
        const Quality level = quality_of(quality);
        return released([&] { return std::make_unique<Bvh>(vertices, faces, kind, level); });
      }),
      "vertices"_a, "faces"_a, "volume"_a = "box", "quality"_a = "medium",
      "vertices: (N, 3) m; faces: (M, 3) indices; volume: box, sphere or oriented_box; quality: "
      "low (fastest build), medium or high (fastest queries).");
  bind_queries(bvh);
  bvh.def(
         "refit",
         [](Bvh& tree, const Rows& v) {
           const Map vertices = rows(v, "vertices");
           released([&] { return tree.refit(vertices), 0; });
         },
         "vertices"_a, "The same faces with moved vertices, (N, 3) m.")
      .def_property_readonly("depth", &Bvh::depth)
      .def_property_readonly("node_count", &Bvh::node_count)
      .def_property_readonly("rebuilt_parts", &Bvh::rebuilt_parts);

  py::class_<HashGrid> grid(
      m, "HashGrid",
      "Uniform grid over the faces of a mesh, cells hashed on (i, j, k). Same "
      "queries and answers as Bvh.");
  grid.def(
      py::init([](const Rows& v, const py::array& f, std::optional<double> cell_size) {
        const Map vertices = rows(v, "vertices");
        const FaceRows indices = face_rows(f);
        const FaceMap faces = faces_of(indices);
        return released([&] { return std::make_unique<HashGrid>(vertices, faces, cell_size); });
      }),
      "vertices"_a, "faces"_a, "cell_size"_a = py::none(),
      "vertices: (N, 3) m; faces: (M, 3) indices; cell_size: m, chosen from the faces if None.");
  bind_queries(grid);
  grid.def_property_readonly("cell_size", &HashGrid::cell_size, "m")
      .def_property_readonly("cell_count", &HashGrid::cell_count)
      .def_property_readonly("entry_count", &HashGrid::entry_count);

  py::module_ broad = m.def_submodule("broad", "Moving boxes, and a mesh without an index.");
  py::class_<AllFaces> all(broad, "AllFaces",
                           "No index: every query looks at every face. What Bvh and HashGrid are "
                           "held against.");
  all.def(py::init([](const Rows& v, const py::array& f) {
            const FaceRows indices = face_rows(f);
            return std::make_unique<AllFaces>(rows(v, "vertices"), faces_of(indices));
          }),
          "vertices"_a, "faces"_a);
  bind_queries(all);

  py::class_<BoxTree>(broad, "BoxTree",
                      "Overlapping pairs among boxes that move a little from step to step.")
      .def(py::init<>())
      .def(
          "update",
          [](BoxTree& tree, const Rows& l, const Rows& u, py::object moves) {
            const std::vector<Aabb> boxes = boxes_of(rows(l, "lower"), rows(u, "upper"));
            std::vector<std::uint8_t> flag(boxes.size(), 1);
            if (!moves.is_none()) {
              const auto given = py::array_t<bool, py::array::forcecast>::ensure(moves);
              if (!given || given.ndim() != 1)
                throw InvalidInput("moves", "not an array of one dimension", "must be (N,) bool");
              flag.clear();
              for (py::ssize_t i = 0; i < given.size(); ++i) flag.push_back(given.at(i) ? 1 : 0);
            }
            return pair_rows(tree.update(boxes, flag));
          },
          "lower"_a, "upper"_a, "moves"_a = py::none(),
          "Takes the boxes of this step, (N, 3) m, infinite bounds allowed; moves: (N,) bool, all "
          "if None; two static boxes are no pair.\nReturns (K, 2) rows a < b, ascending.")
      .def(
          "overlaps",
          [](const BoxTree& tree, const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
            std::vector<int> found;
            tree.overlaps({lower, upper}, found);
            return column<int>(found, [](int x) { return x; });
          },
          "lower"_a, "upper"_a, "Rows of the boxes that overlap one box, ascending.")
      .def(
          "crossed",
          [](const BoxTree& tree, const Eigen::Vector3d& start, const Eigen::Vector3d& end) {
            std::vector<int> found;
            tree.crossed(start, end, found);
            return column<int>(found, [](int x) { return x; });
          },
          "start"_a, "end"_a, "Rows of the boxes a segment may touch, ascending.")
      .def("__len__", &BoxTree::size);
}
