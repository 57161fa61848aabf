// SPDX-License-Identifier: Apache-2.0
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "carom/numerics/invalid_input.hpp"
#include "carom/scene/scene.hpp"

#include "body_arguments.hpp"
#include "module.hpp"

namespace py = pybind11;
using namespace py::literals;
using namespace carom;

namespace {

/// The effects of a scene as Python's lists behave, each checked as it goes in.
struct EffectList {
  py::object scene;

  std::vector<Effect>& items() const { return scene.cast<Scene&>().effects; }
  std::size_t index(py::ssize_t i) const {
    const auto size = static_cast<py::ssize_t>(items().size());
    if (i < 0) i += size;
    if (i < 0 || i >= size)
      throw py::index_error("effects has " + std::to_string(size) + " entries");
    return static_cast<std::size_t>(i);
  }
  static const Effect& checked(const Effect& effect, std::size_t i) {
    require_valid(effect, "effects[" + std::to_string(i) + "]");
    return effect;
  }
  void insert(py::ssize_t i, const Effect& effect) const {
    const auto size = static_cast<py::ssize_t>(items().size());
    i = std::clamp(i < 0 ? i + size : i, py::ssize_t{0}, size);
    items().insert(items().begin() + i, checked(effect, static_cast<std::size_t>(i)));
  }
  void assign(const std::vector<Effect>& effects) const {
    for (std::size_t i = 0; i < effects.size(); ++i) checked(effects[i], i);
    items() = effects;
  }
};

void bind_effect_list(py::module_& m) {
  py::class_<EffectList> list(m, "EffectList",
                              "The effects of a scene: a list that checks what goes in.");
  list.def("__len__", [](const EffectList& l) { return l.items().size(); })
      .def("__getitem__", [](const EffectList& l, py::ssize_t i) { return l.items()[l.index(i)]; })
      .def("__setitem__",
           [](const EffectList& l, py::ssize_t i, const Effect& effect) {
             l.items()[l.index(i)] = EffectList::checked(effect, l.index(i));
           })
      .def("__delitem__",
           [](const EffectList& l, py::ssize_t i) {
             l.items().erase(l.items().begin() + static_cast<std::ptrdiff_t>(l.index(i)));
           })
      .def("__iter__", [](const EffectList& l) { return py::iter(py::cast(l.items())); })
      .def(
          "append",
          [](const EffectList& l, const Effect& e) {
            l.insert(static_cast<py::ssize_t>(l.items().size()), e);
          },
          "effect"_a)
      .def("insert", &EffectList::insert, "index"_a, "effect"_a)
      .def(
          "extend",
          [](const EffectList& l, const std::vector<Effect>& effects) {
            std::vector<Effect> all = l.items();
            all.insert(all.end(), effects.begin(), effects.end());
            l.assign(all);
          },
          "effects"_a)
      .def(
          "pop",
          [](const EffectList& l, py::ssize_t i) {
            const auto at = l.items().begin() + static_cast<std::ptrdiff_t>(l.index(i));
            const Effect effect = *at;
            l.items().erase(at);
            return effect;
          },
          "index"_a = -1)
      .def("clear", [](const EffectList& l) { l.items().clear(); })
      .def("__repr__", [](const EffectList& l) { return py::repr(py::cast(l.items())); });
}

void bind_body(py::module_& m) {
  using Body = Scene::Body;
  py::class_<Body>(m, "Body", "A body as its scene describes it: a copy, read-only.")
      .def_readonly("id", &Body::id)
      .def_readonly("name", &Body::name)
      .def_readonly("shape", &Body::shape)
      .def_readonly("static", &Body::is_static)
      .def_property_readonly(
          "mass_properties", [](const Body& b) { return b.properties; },
          "in the body frame; zero mass for a static body")
      .def_property_readonly(
          "position", [](const Body& b) { return b.pose.position; }, "(3,) m, at the start")
      .def_property_readonly(
          "orientation", [](const Body& b) { return b.pose.orientation.coeffs(); },
          "(4,) x y z w, at the start")
      .def_property_readonly(
          "velocity", [](const Body& b) { return b.velocity; },
          "(3,) m/s, of the body frame's origin, at the start")
      .def_property_readonly(
          "angular_velocity", [](const Body& b) { return b.angular_velocity; },
          "(3,) rad/s, world axes, at the start")
      .def_readonly("friction", &Body::friction)
      .def_readonly("restitution", &Body::restitution)
      .def_readonly("rolling_resistance", &Body::rolling_resistance, "m")
      .def_readonly("spinning_resistance", &Body::spinning_resistance, "m")
      .def_property_readonly(
          "ccd",
          [](const Body& b) {
            return b.ccd == Ccd::automatic ? "auto" : b.ccd == Ccd::always ? "always" : "never";
          },
          "'auto', 'always' or 'never'")
      .def_readonly("groups", &Body::groups, "bits of the groups it belongs to")
      .def_readonly("meets", &Body::meets, "bits of the groups it meets")
      .def("__repr__", [](const Body& b) {
        return py::str("<Body {} {!r} {!r}{}>")
            .format(b.id, b.name, b.shape, b.is_static ? " static" : "");
      });
}

}  // namespace

void bind_scene(py::module_& m) {
  bind_body(m);
  bind_effect_list(m);

  py::class_<Scene> scene(m, "Scene", "Everything a simulation is told: bodies and effects.");
  scene.def(py::init<>())
      .def_static(
          "load",
          [](const py::object& path) {
            return py::module_::import("carom.scene_file").attr("load")(path).cast<Scene>();
          },
          "path"_a,
          "Reads a scene file (YAML). Raises InvalidInput naming file, line, field and rule.");
  python::define_add(scene,
                     [](Scene& self, BodyDefinition body) { return self.add(std::move(body)); });
  scene
      .def(
          "remove",
          [](Scene& self, const python::BodyLike& body) {
            self.remove(python::body_id(body, self));
          },
          "body"_a, "Takes a body out by id or name; the rows after it close up.")
      .def(
          "never_meet",
          [](Scene& self, const python::BodyLike& a, const python::BodyLike& b) {
            self.never_meet(python::body_id(a, self), python::body_id(b, self));
          },
          "a"_a, "b"_a,
          "Lets two bodies, by id or name, pass through each other, whatever their groups.")
      .def_property_readonly(
          "never",
          [](const Scene& self) {
            std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
            for (const auto& [a, b] : self.never) pairs.emplace_back(a.value, b.value);
            return pairs;
          },
          "Pairs of ids that never meet.")
      .def(
          "find", [](const Scene& self, const std::string& name) { return self.find(name); },
          "name"_a, "Id of the body of that name, or None.")
      .def_property_readonly(
          "bodies", [](const Scene& self) { return self.bodies; },
          "Copies of the bodies, in the order of rows.")
      .def_property(
          "effects", [](const py::object& self) { return EffectList{self}; },
          [](const py::object& self, const std::vector<Effect>& effects) {
            EffectList{self}.assign(effects);
          },
          "What acts on the bodies: a list to append to.")
      .def("__len__", [](const Scene& self) { return self.bodies.size(); })
      .def("__copy__", [](const Scene& self) { return Scene(self); })
      .def(
          "__deepcopy__", [](const Scene& self, const py::dict&) { return Scene(self); }, "memo"_a)
      .def("__repr__", [](const Scene& self) {
        return py::str("<Scene of {} bodies, {} effects>")
            .format(self.bodies.size(), self.effects.size());
      });
}
