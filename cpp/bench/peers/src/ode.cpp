// SPDX-License-Identifier: Apache-2.0
#include <ode/ode.h>

#include "peer.h"
struct EO : Engine {
  WorldDef d;
  dWorldID w;
  dSpaceID sp;
  dJointGroupID jg;
  std::vector<dBodyID> b;
  std::vector<State> st;
  std::vector<dGeomID> g;
  int nc = 0;
  std::vector<dReal> mv;
  std::vector<dTriIndex> mi;
  dGeomID mesh = nullptr;
  std::string name() override { return sizeof(dReal) == 8 ? "ode-f64" : "ode-f32"; }
  std::string settings() override {
    return "dWorldQuickStep SOR " + std::to_string(dWorldGetQuickStepNumIterations(w)) +
           " iterations, hash space, 4 contacts per pair, no CCD";
  }
  void begin(const WorldDef& x) override {
    d = x;
    dInitODE2(0);
    dAllocateODEDataForThread(dAllocateMaskAll);
    w = dWorldCreate();
    dWorldSetGravity(w, d.gravity.x, d.gravity.y, d.gravity.z);
    sp = d.num("sap", 0) ? dSweepAndPruneSpaceCreate(0, dSAP_AXES_XYZ) : dHashSpaceCreate(0);
    jg = dJointGroupCreate(0);
    dWorldSetAutoDisableFlag(w, 0);
    dWorldSetQuickStepNumIterations(w, (int)d.num("iters", 20));
  }
  void add(const BodyDef& x) override {
    dGeomID q = x.shape == BOX ? dCreateBox(sp, 2 * x.half.x, 2 * x.half.y, 2 * x.half.z)
                               : dCreateSphere(sp, x.radius);
    g.push_back(q);
    dQuaternion r = {x.rot.w, x.rot.x, x.rot.y, x.rot.z};
    State s;
    s.p = x.pos;
    s.q = x.rot;
    st.push_back(s);
    if (!x.dynamic) {
      dGeomSetPosition(q, x.pos.x, x.pos.y, x.pos.z);
      dGeomSetQuaternion(q, r);
      b.push_back(nullptr);
      return;
    }
    dBodyID k = dBodyCreate(w);
    dMass m;
    if (x.shape == BOX)
      dMassSetBox(&m, x.density, 2 * x.half.x, 2 * x.half.y, 2 * x.half.z);
    else
      dMassSetSphere(&m, x.density, x.radius);
    dBodySetMass(k, &m);
    dBodySetPosition(k, x.pos.x, x.pos.y, x.pos.z);
    dBodySetQuaternion(k, r);
    dBodySetLinearVel(k, x.lin.x, x.lin.y, x.lin.z);
    dBodySetAngularVel(k, x.ang.x, x.ang.y, x.ang.z);
    dGeomSetBody(q, k);
    b.push_back(k);
  }
  bool addMesh(const Mesh& m) override {
    mv.assign(m.v.begin(), m.v.end());
    mi.assign(m.tri.begin(), m.tri.end());
    dTriMeshDataID t = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(t, mv.data(), 3 * sizeof(dReal), mv.size() / 3, mi.data(),
                                mi.size(), 3 * sizeof(dTriIndex));
    mesh = dCreateTriMesh(sp, t, 0, 0, 0);
    return true;
  }
  void end() override {}
  static void near(void* p, dGeomID a, dGeomID c) {
    EO* e = (EO*)p;
    dBodyID x = dGeomGetBody(a), y = dGeomGetBody(c);
    if (!x && !y) return;
    dContact k[8];
    int mx = (a == e->mesh || c == e->mesh) ? 8 : 4;
    int n = dCollide(a, c, mx, &k[0].geom, sizeof(dContact));
    for (int i = 0; i < n; i++) {
      k[i].surface.mode = dContactApprox1;
      k[i].surface.mu = e->d.friction;
      dJointAttach(dJointCreateContact(e->w, e->jg, &k[i]), x, y);
    }
    e->nc += n;
  }
  void step(double dt) override {
    nc = 0;
    dSpaceCollide(sp, this, near);
    dWorldQuickStep(w, dt);
    dJointGroupEmpty(jg);
  }
  State get(int i) override {
    if (!b[i]) return st[i];
    const dReal *p = dBodyGetPosition(b[i]), *q = dBodyGetQuaternion(b[i]),
                *v = dBodyGetLinearVel(b[i]), *a = dBodyGetAngularVel(b[i]);
    return {{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}, {v[0], v[1], v[2]}, {a[0], a[1], a[2]}};
  }
  int contacts() override { return nc; }
  long rays(const std::vector<V3>& o, const std::vector<V3>& r, std::vector<double>& f) override {
    long h = 0;
    dGeomID ray = dCreateRay(0, 1);
    dGeomRaySetClosestHit(ray, 1);
    for (size_t i = 0; i < o.size(); i++) {
      double l = norm(r[i]);
      dGeomRaySetLength(ray, l);
      dGeomRaySet(ray, o[i].x, o[i].y, o[i].z, r[i].x / l, r[i].y / l, r[i].z / l);
      dContactGeom c;
      int n = mesh ? dCollide(ray, mesh, 1, &c, sizeof c) : 0;
      f[i] = n ? c.depth / l : 2;
      h += n;
    }
    return h;
  }
};
Engine* makeEngine() {
  return new EO;
}
