// SPDX-License-Identifier: Apache-2.0
// Engine-neutral interface of the peer harness. Every engine gets one adaptor
// file; scenes, timing and accuracy figures live in driver.cpp and are shared.
#pragma once
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

struct V3 {
  double x = 0, y = 0, z = 0;
};
struct Q4 {
  double w = 1, x = 0, y = 0, z = 0;
};
inline V3 operator+(V3 a, V3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline V3 operator-(V3 a, V3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline V3 operator*(double s, V3 a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline double dot(V3 a, V3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline V3 cross(V3 a, V3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(V3 a) {
  return std::sqrt(dot(a, a));
}
inline V3 rotate(Q4 q, V3 v) {
  V3 u{q.x, q.y, q.z};
  V3 t = 2.0 * cross(u, v);
  return v + q.w * t + cross(u, t);
}

enum Shape { BOX, SPHERE };
struct BodyDef {
  Shape shape = BOX;
  V3 half{0.25, 0.25, 0.25};  // box half extents
  double radius = 0.25;       // sphere radius
  V3 pos;
  Q4 rot;
  V3 lin, ang;  // world frame
  bool dynamic = true;
  double density = 1000;
  bool ccd = false;
};
struct Mesh {  // static triangle mesh, CCW seen from +z; also given as a regular height grid
  std::vector<double> v;
  std::vector<int> tri;
  int nx = 0, ny = 0;  // grid nodes
  double size = 0;     // side length, centred at the origin
};
struct WorldDef {
  V3 gravity{0, 0, -9.81};
  double dt = 1.0 / 60;
  int threads = 1;
  int nbodies = 0;
  bool ccd = false;       // engine's continuous collision on (scene uses it)
  double friction = 0.5;  // combined pair value wanted
  std::map<std::string, std::string> opt;
  double num(const std::string& k, double def) const {
    auto i = opt.find(k);
    return i == opt.end() ? def : std::stod(i->second);
  }
};
struct State {
  V3 p;
  Q4 q;
  V3 v, w;
};
struct Engine {
  virtual ~Engine() {}
  virtual std::string name() = 0;
  virtual std::string settings() = 0;
  virtual void begin(const WorldDef&) = 0;
  virtual void add(const BodyDef&) = 0;  // index = order of calls
  virtual bool addMesh(const Mesh&) = 0;
  virtual void end() = 0;  // all bodies added: optimise broad phase etc.
  virtual void step(double dt) = 0;
  virtual State get(int i) = 0;
  virtual int contacts() { return -1; }  // contact points (engine's own count)
  // closest-hit segment queries o -> o+d; returns hits, frac[i] = 2 for miss
  virtual long rays(const std::vector<V3>&, const std::vector<V3>&, std::vector<double>&) {
    return -1;
  }
};
Engine* makeEngine();
