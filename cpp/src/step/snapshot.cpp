// SPDX-License-Identifier: Apache-2.0
// Save and restore: every value the next steps depend on, bit for bit. One list serves both ways.
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>

#include "carom/numerics/invalid_input.hpp"

#include "step/world.hpp"

namespace carom {
namespace {

// Raised whenever the list below changes. Two lists were both called 3, so neither is read.
constexpr std::uint32_t format = 5;

/// FNV-1a, 64 bits.
std::uint64_t hash_of(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

struct Writer {
  std::string bytes;

  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(&v), sizeof(T));
  }
  template <class T>
  void array(const std::vector<T>& v) {
    value(v.size());
    for (const T& x : v) value(x);
  }
};

struct Reader {
  const std::string& bytes;
  std::size_t at = 0;

  template <class T>
  void value(T& v) {
    if (bytes.size() - at < sizeof(T))
      throw InvalidInput("bytes", std::to_string(bytes.size()) + " bytes", "end too early",
                         "restore what save() gave, whole");
    std::memcpy(&v, bytes.data() + at, sizeof(T));
    at += sizeof(T);
  }
  void require_room(std::size_t entries) const {
    if (entries > bytes.size() - at)
      throw InvalidInput("bytes", std::to_string(entries) + " entries", "are more than they hold");
  }
  template <class T>
  void array(std::vector<T>& v) {
    std::size_t n = 0;
    value(n);
    require_room(n);
    v.resize(n);
    for (T& x : v) value(x);
  }
};

// Eigen's vectors copy by hand-written members, so they are taken as their coefficients.
template <class Io, class V>
void vector3(Io& io, V& v) {
  for (int i = 0; i < 3; ++i) io.value(v[i]);
}

template <class Io, class Wrench>
void wrench(Io& io, Wrench& w) {
  io.value(w.body);
  vector3(io, w.force);
  vector3(io, w.torque);
  vector3(io, w.point_b);
  io.value(w.in_body_axes);
  io.value(w.until);
}

template <class Io, class List, class Each>
void list(Io& io, List& items, Each each) {
  std::size_t n = items.size();
  io.value(n);
  if constexpr (!std::is_const_v<List>) {
    io.require_room(n);
    items.resize(n);
  }
  for (auto& item : items) each(item);
}

template <class Io, class Contacts>
void contacts(Io& io, Contacts& all) {
  list(io, all, [&](auto& c) {
    io.value(c.a);
    io.value(c.b);
    io.value(c.feature);
    io.value(c.separation);
    io.value(c.friction);
    io.value(c.restitution);
    vector3(io, c.normal);
    vector3(io, c.position);
    io.value(c.rolling_resistance);
    io.value(c.spinning_resistance);
    vector3(io, c.impulse);
    vector3(io, c.turning_impulse);
    vector3(io, c.impulse_at_end);
    io.value(c.dissipated);
  });
}

template <class Io, class W>
void everything(Io& io, W& world) {
  auto& s = world.states;
  for (auto* a : {&s.position, &s.velocity, &s.angular_momentum, &s.inverse_moments}) {
    io.array(a->x);
    io.array(a->y);
    io.array(a->z);
  }
  for (auto* a : {&s.orientation.x, &s.orientation.y, &s.orientation.z, &s.orientation.w, &s.mass,
                  &s.inverse_mass})
    io.array(*a);
  io.array(s.moves);
  io.value(world.report.time);
  io.value(world.clock);
  io.value(world.report.steps);
  io.value(world.options.dt);
  io.value(world.options.integrator);
  io.value(world.dissipated);
  io.value(world.work);
  io.value(world.repulsion);
  io.array(world.report.frozen);
  contacts(io, world.contacts);
  io.array(world.solver.memory.newton);
  io.array(world.solver.memory.held_off);
  io.array(world.solver.memory.direct);
  io.array(world.solver.memory.substeps);
  io.array(world.solver.memory.island);
  io.array(world.manifold_cache.pairs);
  io.array(world.manifold_cache.points);
  io.array(world.asleep);
  io.array(world.bed);
  io.array(world.still);
  contacts(io, world.asleep_contacts);
  io.array(world.sweep.waited);
  list(io, world.requests, [&](auto& r) {
    io.value(r.row);
    for (auto* v : {&r.force, &r.torque, &r.impulse, &r.angular_impulse}) vector3(io, *v);
  });
}

/// Bytes whose lists do not fit the bodies were not written by save().
void require_rows(const World& world, int rows) {
  const auto fits = [&](const auto& v) { return v.size() == static_cast<std::size_t>(rows); };
  const BodyStates& s = world.states;
  bool good = fits(s.mass) && fits(s.inverse_mass) && fits(s.moves);
  for (const Array3* a : {&s.position, &s.velocity, &s.angular_momentum, &s.inverse_moments})
    good = good && fits(a->x) && fits(a->y) && fits(a->z);
  const Array4& q = s.orientation;
  good = good && fits(q.x) && fits(q.y) && fits(q.z) && fits(q.w);
  const auto row = [&](int i) { return i >= 0 && i < rows; };
  for (const auto* all : {&world.contacts, &world.asleep_contacts})
    for (const Contact& c : *all) good = good && row(c.a) && row(c.b);
  for (const auto* rows_of : {&world.asleep, &world.sweep.waited})
    good = good && (rows_of->empty() || fits(*rows_of));
  for (const auto* islands : {&world.bed, &world.solver.memory.island})
    for (const std::int32_t i : *islands) good = good && i < rows;
  good = good && world.bed.size() == world.asleep.size();
  for (const contact::ManifoldCache::Pair& p : world.manifold_cache.pairs)
    good = good && row(p.a) && row(p.b) && p.first >= 0 && p.count >= 0 &&
           static_cast<std::size_t>(p.first) + static_cast<std::size_t>(p.count) <=
               world.manifold_cache.points.size();
  for (const Request& r : world.requests) good = good && row(r.row);
  if (!good) throw InvalidInput("bytes", "a list", "does not fit the bodies");
}

template <class Io>
void header(Io& io, Scene& scene) {
  std::uint32_t version = format;
  io.value(version);
  if (version != format)
    throw InvalidInput("bytes", "format " + std::to_string(version),
                       "must be of format " + std::to_string(format),
                       version < format ? "an older carom saved them: restore them there"
                                        : "a newer carom saved them: restore them there");
  std::vector<BodyId> ids;
  for (const Scene::Body& body : scene.bodies) ids.push_back(body.id);
  const std::vector<BodyId> expected = ids;
  io.array(ids);
  if (ids != expected)
    throw InvalidInput("bytes", std::to_string(ids.size()) + " bodies",
                       "must come from a simulation of the same bodies");
}

std::vector<AppliedWrench> held_wrenches(const Scene& scene) {
  std::vector<AppliedWrench> held;
  for (const Effect& effect : scene.effects)
    if (const auto* w = std::get_if<AppliedWrench>(&effect)) held.push_back(*w);
  return held;
}

}  // namespace

std::string Simulation::save() const {
  Writer writer;
  header(writer, world_->scene);
  everything(writer, std::as_const(*world_));
  const std::vector<AppliedWrench> held = held_wrenches(world_->scene);
  list(writer, held, [&](const AppliedWrench& w) { wrench(writer, w); });
  writer.value(hash_of(writer.bytes));
  return std::move(writer.bytes);
}

void Simulation::restore(const std::string& bytes) {
  // All or nothing: a first reading into a world of its own finds what is wrong with the bytes.
  std::vector<AppliedWrench> held;
  const auto read_into = [&](World& world) {
    Reader reader{bytes};
    header(reader, world_->scene);
    everything(reader, world);
    list(reader, held, [&](AppliedWrench& w) { wrench(reader, w); });
    const std::uint64_t found = hash_of(std::string_view(bytes).substr(0, reader.at));
    std::uint64_t saved = 0;
    reader.value(saved);
    if (reader.at != bytes.size())
      throw InvalidInput("bytes", std::to_string(bytes.size()) + " bytes", "are more than a state");
    if (found != saved)
      throw InvalidInput("bytes", "their sum", "does not match: they are damaged",
                         "restore what save() gave, unchanged");
  };
  World trial;
  read_into(trial);
  require_rows(trial, world_->states.size());
  read_into(*world_);

  Scene& scene = world_->scene;
  std::erase_if(scene.effects,
                [](const Effect& e) { return std::holds_alternative<AppliedWrench>(e); });
  scene.effects.insert(scene.effects.end(), held.begin(), held.end());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    scene.bodies[i].is_static =
        !world_->states.moves[i] && !(i < world_->asleep.size() && world_->asleep[i]);
  world_->plan_is_stale = true;
}

std::uint64_t Simulation::state_hash() const {
  return hash_of(save());
}

}  // namespace carom
