// SPDX-License-Identifier: Apache-2.0
#include <btBulletDynamicsCommon.h>

#include "peer.h"
struct EB : Engine {
  WorldDef d;
  btDefaultCollisionConfiguration* cc;
  btCollisionDispatcher* disp;
  btBroadphaseInterface* bp;
  btSequentialImpulseConstraintSolver* sol;
  btDiscreteDynamicsWorld* w;
  std::vector<btRigidBody*> b;
  std::map<std::string, btCollisionShape*> cache;
  std::vector<btScalar> mv;
  std::vector<int> mi;
  std::string name() override { return sizeof(btScalar) == 8 ? "bullet-f64" : "bullet-f32"; }
  std::string settings() override {
    return "PGS " + std::to_string(w->getSolverInfo().m_numIterations) +
           " iterations, split impulse, dbvt, implicit gyro, margin 0.04 default";
  }
  void begin(const WorldDef& wd) override {
    d = wd;
    cc = new btDefaultCollisionConfiguration;
    disp = new btCollisionDispatcher(cc);
    bp = new btDbvtBroadphase;
    sol = new btSequentialImpulseConstraintSolver;
    w = new btDiscreteDynamicsWorld(disp, bp, sol, cc);
    w->setGravity(btVector3(d.gravity.x, d.gravity.y, d.gravity.z));
    w->getSolverInfo().m_numIterations = (int)d.num("iters", 10);
  }
  void put(btCollisionShape* s, const BodyDef& x) {
    btScalar m = 0;
    btVector3 I(0, 0, 0);
    if (x.dynamic) {
      double v = x.shape == BOX ? 8 * x.half.x * x.half.y * x.half.z
                                : 4.0 / 3 * M_PI * x.radius * x.radius * x.radius;
      m = v * x.density;
      s->calculateLocalInertia(m, I);
    }
    btTransform t(btQuaternion(x.rot.x, x.rot.y, x.rot.z, x.rot.w),
                  btVector3(x.pos.x, x.pos.y, x.pos.z));
    btRigidBody::btRigidBodyConstructionInfo ci(m, nullptr, s, I);
    ci.m_startWorldTransform = t;
    ci.m_friction = std::sqrt(d.friction);
    btRigidBody* r = new btRigidBody(ci);
    r->setLinearVelocity(btVector3(x.lin.x, x.lin.y, x.lin.z));
    r->setAngularVelocity(btVector3(x.ang.x, x.ang.y, x.ang.z));
    r->setActivationState(x.dynamic ? DISABLE_DEACTIVATION : ACTIVE_TAG);
    if (x.ccd) {
      double rad = x.shape == BOX ? std::min(x.half.x, std::min(x.half.y, x.half.z)) : x.radius;
      r->setCcdMotionThreshold(rad * 0.5);
      r->setCcdSweptSphereRadius(rad * 0.8);
    }
    w->addRigidBody(r);
    b.push_back(r);
  }
  void add(const BodyDef& x) override {
    char k[96];
    snprintf(k, sizeof k, "%d %a %a %a %a", x.shape, x.half.x, x.half.y, x.half.z, x.radius);
    auto& s = cache[k];
    if (!s)
      s = x.shape == BOX
              ? (btCollisionShape*)new btBoxShape(btVector3(x.half.x, x.half.y, x.half.z))
              : new btSphereShape(x.radius);
    put(s, x);
  }
  bool addMesh(const Mesh& m) override {
    mv.assign(m.v.begin(), m.v.end());
    mi = m.tri;
    btIndexedMesh im;
    im.m_numTriangles = mi.size() / 3;
    im.m_triangleIndexBase = (const unsigned char*)mi.data();
    im.m_triangleIndexStride = 12;
    im.m_numVertices = mv.size() / 3;
    im.m_vertexBase = (const unsigned char*)mv.data();
    im.m_vertexStride = 3 * sizeof(btScalar);
    im.m_vertexType = sizeof(btScalar) == 8 ? PHY_DOUBLE : PHY_FLOAT;
    auto* ia = new btTriangleIndexVertexArray;
    ia->addIndexedMesh(im);
    BodyDef x;
    x.dynamic = false;
    put(new btBvhTriangleMeshShape(ia, true), x);
    return true;
  }
  void end() override {}
  void step(double dt) override { w->stepSimulation(dt, 0, dt); }
  State get(int i) override {
    State s;
    auto& t = b[i]->getCenterOfMassTransform();
    btQuaternion q = t.getRotation();
    auto& v = b[i]->getLinearVelocity();
    auto& a = b[i]->getAngularVelocity();
    s.p = {t.getOrigin().x(), t.getOrigin().y(), t.getOrigin().z()};
    s.q = {q.w(), q.x(), q.y(), q.z()};
    s.v = {v.x(), v.y(), v.z()};
    s.w = {a.x(), a.y(), a.z()};
    return s;
  }
  int contacts() override {
    int n = 0;
    for (int i = 0; i < disp->getNumManifolds(); i++)
      n += disp->getManifoldByIndexInternal(i)->getNumContacts();
    return n;
  }
  long rays(const std::vector<V3>& o, const std::vector<V3>& r, std::vector<double>& f) override {
    long h = 0;
    for (size_t i = 0; i < o.size(); i++) {
      btVector3 a(o[i].x, o[i].y, o[i].z), e = a + btVector3(r[i].x, r[i].y, r[i].z);
      btCollisionWorld::ClosestRayResultCallback cb(a, e);
      w->rayTest(a, e, cb);
      f[i] = cb.hasHit() ? (double)cb.m_closestHitFraction : 2;
      h += cb.hasHit();
    }
    return h;
  }
};
Engine* makeEngine() {
  return new EB;
}
