// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <cstdlib>
#include <mujoco/mujoco.h>

#include "peer.h"
struct EM : Engine {
  WorldDef d;
  mjSpec* s;
  mjModel* m = nullptr;
  mjData* x = nullptr;
  std::vector<int> body;
  std::vector<BodyDef> bd;
  std::string name() override { return "mujoco-f64"; }
  std::string settings() override {
    return std::string("Newton <=") + std::to_string(m->opt.iterations) + " it, tol 1e-8, " +
           (m->opt.cone ? "elliptic" : "pyramidal") + " cone, integrator " +
           std::to_string(m->opt.integrator) + ", soft contact solref 0.02, no CCD";
  }
  void begin(const WorldDef& w) override {
    d = w;
    s = mj_makeSpec();
    s->option.timestep = d.dt;
    s->option.gravity[0] = d.gravity.x;
    s->option.gravity[1] = d.gravity.y;
    s->option.gravity[2] = d.gravity.z;
    s->option.integrator = (int)d.num("integrator", 0);
    s->option.cone = (int)d.num("cone", 0);
    s->option.jacobian = mjJAC_AUTO;
    if (d.opt.count("iters")) s->option.iterations = (int)d.num("iters", 100);
    if (d.opt.count("solver")) s->option.solver = (int)d.num("solver", 2);
    s->memory = (mjtSize)6 << 30;
  }
  void add(const BodyDef& b) override {
    mjsBody* wb = mjs_findBody(s, "world");
    mjsBody* q = wb;
    char nm[32];
    bd.push_back(b);
    if (b.dynamic) {
      q = mjs_addBody(wb, nullptr);
      snprintf(nm, sizeof nm, "b%zu", bd.size());
      mjs_setName(q->element, nm);
      q->pos[0] = b.pos.x;
      q->pos[1] = b.pos.y;
      q->pos[2] = b.pos.z;
      q->quat[0] = b.rot.w;
      q->quat[1] = b.rot.x;
      q->quat[2] = b.rot.y;
      q->quat[3] = b.rot.z;
      mjs_addFreeJoint(q);
    }
    mjsGeom* g = mjs_addGeom(q, nullptr);
    g->type = b.shape == BOX ? mjGEOM_BOX : mjGEOM_SPHERE;
    g->size[0] = b.shape == BOX ? b.half.x : b.radius;
    g->size[1] = b.half.y;
    g->size[2] = b.half.z;
    g->density = b.density;
    g->friction[0] = d.friction;
    if (!b.dynamic) {
      g->pos[0] = b.pos.x;
      g->pos[1] = b.pos.y;
      g->pos[2] = b.pos.z;
    }
  }
  bool addMesh(const Mesh& t) override {
    mjsBody* wb = mjs_findBody(s, "world");
    if (d.opt["scene"] == "rays") {
      mjsMesh* h = mjs_addMesh(s, nullptr);
      mjs_setName(h->element, "t");
      h->inertia = mjMESH_INERTIA_SHELL;
      std::vector<float> v(t.v.begin(), t.v.end());
      mjs_setFloat(h->uservert, v.data(), v.size());
      mjs_setInt(h->userface, t.tri.data(), t.tri.size());
      mjsGeom* g = mjs_addGeom(wb, nullptr);
      g->type = mjGEOM_MESH;
      mjs_setString(g->meshname, "t");
      g->contype = g->conaffinity = 0;
      return true;
    }
    double lo = 1e30, hi = -1e30;
    for (size_t i = 2; i < t.v.size(); i += 3) {
      lo = std::fmin(lo, t.v[i]);
      hi = std::fmax(hi, t.v[i]);
    }
    std::vector<float> e;
    for (size_t i = 2; i < t.v.size(); i += 3) e.push_back((t.v[i] - lo) / (hi - lo));
    mjsHField* h = mjs_addHField(s);
    mjs_setName(h->element, "t");
    h->nrow = t.ny;
    h->ncol = t.nx;
    h->size[0] = h->size[1] = t.size / 2;
    h->size[2] = hi - lo;
    h->size[3] = 1;
    mjs_setFloat(h->userdata, e.data(), e.size());
    mjsGeom* g = mjs_addGeom(wb, nullptr);
    g->type = mjGEOM_HFIELD;
    mjs_setString(g->hfieldname, "t");
    g->pos[2] = lo;
    g->friction[0] = d.friction;
    return true;
  }
  void end() override {
    m = mj_compile(s, nullptr);
    if (!m) {
      printf("{\"error\": \"%s\"}\n", mjs_getError(s));
      exit(0);
    }
    x = mj_makeData(m);
    int j = 0;
    for (auto& b : bd) {
      if (!b.dynamic) {
        body.push_back(-1);
        continue;
      }
      double* v = x->qvel + 6 * j;
      V3 a = rotate({b.rot.w, -b.rot.x, -b.rot.y, -b.rot.z}, b.ang);
      v[0] = b.lin.x;
      v[1] = b.lin.y;
      v[2] = b.lin.z;
      v[3] = a.x;
      v[4] = a.y;
      v[5] = a.z;
      body.push_back(j++);
    }
  }
  void step(double) override { mj_step(m, x); }
  State get(int i) override {
    if (body[i] < 0) return {};
    const double *p = x->qpos + 7 * body[i], *v = x->qvel + 6 * body[i];
    Q4 q{p[3], p[4], p[5], p[6]};
    return {{p[0], p[1], p[2]}, q, {v[0], v[1], v[2]}, rotate(q, {v[3], v[4], v[5]})};
  }
  int contacts() override { return x->ncon; }
  long rays(const std::vector<V3>& o, const std::vector<V3>& r, std::vector<double>& f) override {
    long h = 0;
    mj_kinematics(m, x);
    for (size_t i = 0; i < o.size(); i++) {
      int gid[1] = {-1};
      double t = mj_ray(m, x, &o[i].x, &r[i].x, nullptr, 1, -1, gid, nullptr);
      bool k = t >= 0 && t <= 1;
      f[i] = k ? t : 2;
      h += k;
    }
    return h;
  }
};
Engine* makeEngine() {
  return new EM;
}
