// SPDX-License-Identifier: Apache-2.0
// carom itself, through its public C++ API and with its defaults, as one more engine.
#include <memory>
#include <sstream>
#include <string>

#include "carom/carom.hpp"

#include "peer.h"

namespace {

Eigen::Vector3d eigen(V3 v) {
  return {v.x, v.y, v.z};
}
V3 plain(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

struct Own : Engine {
  WorldDef world;
  carom::Scene scene;
  carom::SimulationOptions options;
  std::unique_ptr<carom::Simulation> simulation;

  std::string name() override { return "own"; }
  std::string settings() override {
    std::ostringstream out;
    out << "f64, defaults; ms/step:";
    if (simulation)
      for (const carom::StageTime& stage : simulation->report().stages)
        out << ' ' << stage.stage << ' '
            << 1e3 * stage.seconds / static_cast<double>(simulation->report().steps);
    return out.str();
  }
  void begin(const WorldDef& def) override {
    world = def;
    options.dt = def.dt;
    options.threads = def.threads;
    if (const auto i = def.opt.find("method"); i != def.opt.end())
      options.integrator = carom::integrator_named(i->second);
    if (const auto i = def.opt.find("substeps"); i != def.opt.end())
      options.contact.substeps = std::stoi(i->second);
    if (const auto i = def.opt.find("sleep_after"); i != def.opt.end())
      options.sleep_after = std::stod(i->second);
    scene.effects.push_back(carom::UniformGravity{eigen(def.gravity)});
  }
  void add(const BodyDef& def) override {
    carom::BodyDefinition body;
    if (def.shape == BOX) {
      body.shape = carom::Box{2 * eigen(def.half)};
    } else {
      body.shape = carom::Sphere{def.radius};
    }
    body.is_static = !def.dynamic;
    body.density = def.density;
    body.pose = {eigen(def.pos), {def.rot.w, def.rot.x, def.rot.y, def.rot.z}};
    body.velocity = eigen(def.lin);
    body.angular_velocity = eigen(def.ang);
    body.friction = world.friction;
    if (const auto i = world.opt.find("ccd"); i != world.opt.end() && i->second == "0")
      body.ccd = carom::Ccd::never;
    scene.add(std::move(body));
  }
  bool addMesh(const Mesh& mesh) override {
    using Triangles = carom::TriangleMesh;
    Triangles triangles;
    triangles.vertices = Eigen::Map<const Triangles::Vertices>(
        mesh.v.data(), static_cast<Eigen::Index>(mesh.v.size() / 3), 3);
    triangles.faces = Eigen::Map<const Triangles::Faces>(
        mesh.tri.data(), static_cast<Eigen::Index>(mesh.tri.size() / 3), 3);
    carom::BodyDefinition body;
    body.shape = carom::Mesh(std::move(triangles));
    body.is_static = true;
    body.friction = world.friction;
    scene.add(std::move(body));
    return true;
  }
  void end() override { simulation = std::make_unique<carom::Simulation>(scene, options); }
  void step(double dt) override { simulation->step(dt); }
  State get(int i) override {
    const carom::BodyStates& s = simulation->states();
    const carom::Pose pose = s.pose(i);
    const Eigen::Quaterniond& q = pose.orientation;
    return {plain(pose.position),
            {q.w(), q.x(), q.y(), q.z()},
            plain(s.velocity_at(i, pose.position)),
            plain(s.angular_velocity(i))};
  }
  int contacts() override { return static_cast<int>(simulation->contacts().size()); }
};

}  // namespace

Engine* makeEngine() {
  return new Own;
}
