// SPDX-License-Identifier: Apache-2.0
#include <box3d/box3d.h>
#include <cstdio>

#include "peer.h"
struct E3 : Engine {
  b3WorldId w;
  std::vector<b3BodyId> id;
  WorldDef d;
  int sub = 4;
  b3MeshData* md = nullptr;
  std::string name() override {
#ifdef BOX3D_DOUBLE_PRECISION
    return "box3d-f64pos";
#else
    return "box3d-f32";
#endif
  }
  std::string settings() override {
    return "substeps " + std::to_string(sub) + ", soft contacts, default tuning";
  }
  void begin(const WorldDef& wd) override {
    d = wd;
    sub = (int)d.num("substeps", 4);
    b3WorldDef def = b3DefaultWorldDef();
    def.gravity = {(float)d.gravity.x, (float)d.gravity.y, (float)d.gravity.z};
    def.enableSleep = d.num("sleep", 0) != 0;
    def.enableContinuous = d.num("ccd", 1) != 0;
    def.workerCount = d.threads;
    def.maximumLinearSpeed = 2000;
    w = b3CreateWorld(&def);
  }
  b3BodyId body(bool dyn, const BodyDef& b) {
    b3BodyDef bd = b3DefaultBodyDef();
    bd.type = dyn ? b3_dynamicBody : b3_staticBody;
    bd.position.x = b.pos.x;
    bd.position.y = b.pos.y;
    bd.position.z = b.pos.z;
    bd.rotation = {{(float)b.rot.x, (float)b.rot.y, (float)b.rot.z}, (float)b.rot.w};
    bd.linearVelocity = {(float)b.lin.x, (float)b.lin.y, (float)b.lin.z};
    bd.angularVelocity = {(float)b.ang.x, (float)b.ang.y, (float)b.ang.z};
    bd.isBullet = false;  // static-vs-dynamic CCD is always on; isBullet is for dynamic-dynamic
    return b3CreateBody(w, &bd);
  }
  void add(const BodyDef& b) override {
    b3BodyId i = body(b.dynamic, b);
    b3ShapeDef sd = b3DefaultShapeDef();
    sd.density = b.density;
    sd.baseMaterial.friction = d.friction;
    if (b.shape == BOX) {
      b3BoxHull h = b3MakeBoxHull(b.half.x, b.half.y, b.half.z);
      b3CreateHullShape(i, &sd, &h.base);
    } else {
      b3Sphere s = {{0, 0, 0}, (float)b.radius};
      b3CreateSphereShape(i, &sd, &s);
    }
    id.push_back(i);
  }
  bool addMesh(const Mesh& m) override {
    std::vector<b3Vec3> v;
    for (size_t i = 0; i < m.v.size(); i += 3)
      v.push_back({(float)m.v[i], (float)m.v[i + 1], (float)m.v[i + 2]});
    std::vector<int32_t> t(m.tri.begin(), m.tri.end());
    b3MeshDef md_ = {};
    md_.vertices = v.data();
    md_.indices = t.data();
    md_.vertexCount = v.size();
    md_.triangleCount = t.size() / 3;
    md_.identifyEdges = true;
    md_.useMedianSplit = false;
    md = b3CreateMesh(&md_, nullptr, 0);
    b3ShapeDef sd = b3DefaultShapeDef();
    sd.baseMaterial.friction = d.friction;
    b3CreateMeshShape(body(false, BodyDef{}), &sd, md, b3Vec3{1, 1, 1});
    return true;
  }
  void end() override {}
  double pf[12] = {};
  int np = 0;
  void step(double dt) override {
    b3World_Step(w, (float)dt, sub);
    if (d.opt.count("profile")) {
      b3Profile p = b3World_GetProfile(w);
      np++;
      double v[] = {p.step,
                    p.pairs,
                    p.collide,
                    p.solve,
                    p.prepareConstraints,
                    p.integrateVelocities,
                    p.warmStart,
                    p.solveImpulses,
                    p.integratePositions,
                    p.relaxImpulses,
                    p.transforms,
                    p.refit};
      for (int i = 0; i < 12; i++) pf[i] += v[i];
    }
  }
  State get(int i) override {
    State s;
    b3Pos p = b3Body_GetPosition(id[i]);
    b3Quat q = b3Body_GetRotation(id[i]);
    b3Vec3 v = b3Body_GetLinearVelocity(id[i]), a = b3Body_GetAngularVelocity(id[i]);
    s.p = {p.x, p.y, p.z};
    s.q = {q.s, q.v.x, q.v.y, q.v.z};
    s.v = {v.x, v.y, v.z};
    s.w = {a.x, a.y, a.z};
    return s;
  }
  int contacts() override {  // touching manifold points cannot be read cheaply: contact pairs
    b3Counters c = b3World_GetCounters(w);
    if (np) {
      const char* n[] = {"step",      "pairs",    "collide", "solve", "prepare",    "intvel",
                         "warmstart", "solveimp", "intpos",  "relax", "transforms", "refit"};
      for (int i = 0; i < 12; i++) fprintf(stderr, "%s %.3f ", n[i], pf[i] / np);
      fprintf(stderr, "| pairs %d awake %d recycled %d sat %d hit %d colours", c.contactCount,
              c.awakeContactCount, c.recycledContactCount, c.satCallCount, c.satCacheHitCount);
      for (int i = 0; i < 24; i++) fprintf(stderr, " %d", c.colorCounts[i]);
      fprintf(stderr, "\n");
    }
    return c.contactCount;
  }
  long rays(const std::vector<V3>& o, const std::vector<V3>& r, std::vector<double>& f) override {
    long h = 0;
    b3QueryFilter qf = b3DefaultQueryFilter();
    for (size_t i = 0; i < o.size(); i++) {
      b3Pos p;
      p.x = o[i].x;
      p.y = o[i].y;
      p.z = o[i].z;
      b3RayResult q =
          b3World_CastRayClosest(w, p, {(float)r[i].x, (float)r[i].y, (float)r[i].z}, qf);
      f[i] = q.hit ? q.fraction : 2;
      h += q.hit;
    }
    return h;
  }
};
Engine* makeEngine() {
  return new E3;
}
