// SPDX-License-Identifier: Apache-2.0
#include "peer.h"
struct RB {
  int32_t shape, dynamic, ccd;
  double half[3], radius, pos[3], rot[4], lin[3], ang[3], density, friction;
};
extern "C" {
void* rp_new(const double*, int, int, int);
void rp_add(void*, const RB*);
void rp_mesh(void*, const double*, int, const int*, int, double, int);
void rp_step(void*, double);
void rp_get(void*, int, double*);
int rp_contacts(void*);
long rp_rays(void*, const double*, const double*, long, double*);
}
#ifndef RNAME
#define RNAME "rapier"
#endif
struct ER : Engine {
  void* w;
  WorldDef d;
  int it;
  std::string name() override { return RNAME; }
  std::string settings() override {
    return "TGS-soft " + std::to_string(it) +
           " substeps, 1 internal + 1 stabilisation iteration, contact recycling (defaults)";
  }
  void begin(const WorldDef& x) override {
    d = x;
    it = (int)d.num("substeps", 4);
    double g[3] = {d.gravity.x, d.gravity.y, d.gravity.z};
    w = rp_new(g, d.threads, it, (int)d.num("ccd", 1));
  }
  void add(const BodyDef& b) override {
    RB r{b.shape == BOX ? 0 : 1,
         b.dynamic,
         b.ccd,
         {b.half.x, b.half.y, b.half.z},
         b.radius,
         {b.pos.x, b.pos.y, b.pos.z},
         {b.rot.w, b.rot.x, b.rot.y, b.rot.z},
         {b.lin.x, b.lin.y, b.lin.z},
         {b.ang.x, b.ang.y, b.ang.z},
         b.density,
         d.friction};
    rp_add(w, &r);
  }
  bool addMesh(const Mesh& m) override {
    rp_mesh(w, m.v.data(), m.v.size() / 3, m.tri.data(), m.tri.size() / 3, d.friction,
            (int)d.num("meshflags", 0));
    return true;
  }
  void end() override {}
  void step(double dt) override { rp_step(w, dt); }
  State get(int i) override {
    double o[13];
    rp_get(w, i, o);
    return {
        {o[0], o[1], o[2]}, {o[3], o[4], o[5], o[6]}, {o[7], o[8], o[9]}, {o[10], o[11], o[12]}};
  }
  int contacts() override { return rp_contacts(w); }
  long rays(const std::vector<V3>& o, const std::vector<V3>& r, std::vector<double>& f) override {
    return rp_rays(w, &o[0].x, &r[0].x, o.size(), f.data());
  }
};
Engine* makeEngine() {
  return new ER;
}
