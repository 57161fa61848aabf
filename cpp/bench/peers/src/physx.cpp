// SPDX-License-Identifier: Apache-2.0
#include <PxPhysicsAPI.h>
#include <cstdio>
#include <cstdlib>

#include "peer.h"
using namespace physx;
static bool gCcd = false;
static PxFilterFlags flt(PxFilterObjectAttributes a, PxFilterData, PxFilterObjectAttributes b,
                         PxFilterData, PxPairFlags& f, const void*, PxU32) {
  (void)a;
  (void)b;
  f = PxPairFlag::eCONTACT_DEFAULT;
  if (gCcd) f |= PxPairFlag::eDETECT_CCD_CONTACT;
  return PxFilterFlag::eDEFAULT;
}
struct EP : Engine {
  WorldDef d;
  PxDefaultAllocator al;
  PxDefaultErrorCallback er;
  PxFoundation* fo;
  PxPhysics* ph;
  PxScene* sc;
  PxMaterial* mat;
  std::vector<PxRigidActor*> b;
  bool tgs = false;
  int pos = 4, vel = 1;
  std::string name() override { return tgs ? "physx-tgs-f32" : "physx-pgs-f32"; }
  std::string settings() override {
    return std::string(tgs ? "TGS" : "PGS") + " " + std::to_string(pos) + " pos + " +
           std::to_string(vel) + " vel iterations, PCM, PABP, gyro on, patch friction";
  }
  void begin(const WorldDef& w) override {
    d = w;
    tgs = d.num("tgs", 0) != 0;
    pos = (int)d.num("iters", 4);
    vel = (int)d.num("veliters", 1);
    gCcd = d.ccd;
    fo = PxCreateFoundation(PX_PHYSICS_VERSION, al, er);
    ph = PxCreatePhysics(PX_PHYSICS_VERSION, *fo, PxTolerancesScale());
    PxSceneDesc s(ph->getTolerancesScale());
    s.gravity = PxVec3(d.gravity.x, d.gravity.y, d.gravity.z);
    s.cpuDispatcher = PxDefaultCpuDispatcherCreate(d.threads > 1 ? d.threads : 0);
    s.filterShader = flt;
    s.solverType = tgs ? PxSolverType::eTGS : PxSolverType::ePGS;
    s.flags |= PxSceneFlag::eENABLE_PCM;
    if (d.ccd) s.flags |= PxSceneFlag::eENABLE_CCD;
    sc = ph->createScene(s);
    mat = ph->createMaterial(d.friction, d.friction, 0);
  }
  void add(const BodyDef& x) override {
    PxTransform t(PxVec3(x.pos.x, x.pos.y, x.pos.z), PxQuat(x.rot.x, x.rot.y, x.rot.z, x.rot.w));
    PxBoxGeometry bg(x.half.x, x.half.y, x.half.z);
    PxSphereGeometry sg(x.radius);
    const PxGeometry& g = x.shape == BOX ? (const PxGeometry&)bg : sg;
    PxRigidActor* a;
    if (x.dynamic) {
      PxRigidDynamic* r = PxCreateDynamic(*ph, t, g, *mat, x.density);
      r->setLinearVelocity(PxVec3(x.lin.x, x.lin.y, x.lin.z));
      r->setMaxAngularVelocity(1000);
      r->setAngularVelocity(PxVec3(x.ang.x, x.ang.y, x.ang.z));
      r->setAngularDamping(0);
      r->setLinearDamping(0);
      r->setSleepThreshold(0);
      r->setStabilizationThreshold(0);
      r->setSolverIterationCounts(pos, vel);
      r->setRigidBodyFlag(PxRigidBodyFlag::eENABLE_GYROSCOPIC_FORCES, true);
      if (x.ccd) r->setRigidBodyFlag(PxRigidBodyFlag::eENABLE_CCD, true);
      a = r;
    } else
      a = PxCreateStatic(*ph, t, g, *mat);
    sc->addActor(*a);
    b.push_back(a);
  }
  bool addMesh(const Mesh& m) override {
    std::vector<PxVec3> v;
    for (size_t i = 0; i < m.v.size(); i += 3) v.emplace_back(m.v[i], m.v[i + 1], m.v[i + 2]);
    PxTriangleMeshDesc t;
    t.points.count = v.size();
    t.points.stride = sizeof(PxVec3);
    t.points.data = v.data();
    t.triangles.count = m.tri.size() / 3;
    t.triangles.stride = 12;
    t.triangles.data = m.tri.data();
    PxCookingParams cp(ph->getTolerancesScale());
    cp.midphaseDesc = PxMeshMidPhase::eBVH34;
    PxTriangleMesh* tm = PxCreateTriangleMesh(cp, t, ph->getPhysicsInsertionCallback());
    PxRigidStatic* a =
        PxCreateStatic(*ph, PxTransform(PxIdentity), PxTriangleMeshGeometry(tm), *mat);
    sc->addActor(*a);
    b.push_back(a);
    return true;
  }
  void end() override {}
  void step(double dt) override {
    sc->simulate(dt);
    sc->fetchResults(true);
  }
  State get(int i) override {
    PxTransform t = b[i]->getGlobalPose();
    State s{{t.p.x, t.p.y, t.p.z}, {t.q.w, t.q.x, t.q.y, t.q.z}, {}, {}};
    if (auto* r = b[i]->is<PxRigidDynamic>()) {
      PxVec3 v = r->getLinearVelocity(), w = r->getAngularVelocity();
      s.v = {v.x, v.y, v.z};
      s.w = {w.x, w.y, w.z};
    }
    return s;
  }
  int contacts() override {
    PxSimulationStatistics st;
    sc->getSimulationStatistics(st);
    return st.nbDiscreteContactPairsWithContacts;
  }
  long rays(const std::vector<V3>& o, const std::vector<V3>& r, std::vector<double>& f) override {
    long h = 0;
    for (size_t i = 0; i < o.size(); i++) {
      double l = norm(r[i]);
      PxRaycastBuffer hit;
      bool k = sc->raycast(PxVec3(o[i].x, o[i].y, o[i].z),
                           PxVec3(r[i].x / l, r[i].y / l, r[i].z / l), l, hit, PxHitFlag::eDEFAULT);
      f[i] = k ? hit.block.distance / l : 2;
      h += k;
    }
    return h;
  }
};
Engine* makeEngine() {
  return new EP;
}
