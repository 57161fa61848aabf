// SPDX-License-Identifier: Apache-2.0
#include <Jolt/Jolt.h>

#include <Jolt/Core/Factory.h>
#include <Jolt/Core/JobSystemSingleThreaded.h>
#include <Jolt/Core/JobSystemThreadPool.h>
#include <Jolt/Core/TempAllocator.h>
#include <Jolt/Geometry/IndexedTriangle.h>
#include <Jolt/Physics/Body/BodyCreationSettings.h>
#include <Jolt/Physics/Collision/CastResult.h>
#include <Jolt/Physics/Collision/RayCast.h>
#include <Jolt/Physics/Collision/Shape/BoxShape.h>
#include <Jolt/Physics/Collision/Shape/MeshShape.h>
#include <Jolt/Physics/Collision/Shape/SphereShape.h>
#include <Jolt/Physics/PhysicsSettings.h>
#include <Jolt/Physics/PhysicsSystem.h>
#include <Jolt/RegisterTypes.h>
#include <atomic>
#include <memory>

#include "peer.h"
namespace J = JPH;
struct OLF : J::ObjectLayerPairFilter {
  bool ShouldCollide(J::ObjectLayer a, J::ObjectLayer b) const override { return a || b; }
};
struct BPI final : J::BroadPhaseLayerInterface {
  J::uint GetNumBroadPhaseLayers() const override { return 2; }
  J::BroadPhaseLayer GetBroadPhaseLayer(J::ObjectLayer l) const override {
    return J::BroadPhaseLayer(l ? 1 : 0);
  }
#if defined(JPH_EXTERNAL_PROFILE) || defined(JPH_PROFILE_ENABLED)
  const char* GetBroadPhaseLayerName(J::BroadPhaseLayer) const override { return "l"; }
#endif
};
struct OBF : J::ObjectVsBroadPhaseLayerFilter {
  bool ShouldCollide(J::ObjectLayer a, J::BroadPhaseLayer b) const override {
    return a || b != J::BroadPhaseLayer(0);
  }
};
struct EJ : Engine {
  WorldDef d;
  std::unique_ptr<J::TempAllocator> ta;
  std::unique_ptr<J::JobSystem> js;
  std::unique_ptr<J::PhysicsSystem> ps;
  BPI bpi;
  OLF olf;
  OBF obf;
  std::vector<J::BodyID> id;
  int csteps = 1;
  std::string name() override {
#ifdef JPH_DOUBLE_PRECISION
    return "jolt-f64pos";
#else
    return "jolt-f32";
#endif
  }
  std::string settings() override {
    return "10 velocity + 2 position iterations, warm start, " + std::to_string(csteps) +
           " collision step, gyro force on, damping 0";
  }
  void begin(const WorldDef& w) override {
    d = w;
    csteps = (int)d.num("substeps", 1);
    J::RegisterDefaultAllocator();
    J::Factory::sInstance = new J::Factory();
    J::RegisterTypes();
    ta.reset(new J::TempAllocatorImpl(512 << 20));
    if (d.threads > 1)
      js.reset(
          new J::JobSystemThreadPool(J::cMaxPhysicsJobs, J::cMaxPhysicsBarriers, d.threads - 1));
    else
      js.reset(new J::JobSystemSingleThreaded(J::cMaxPhysicsJobs));
    ps.reset(new J::PhysicsSystem);
    ps->Init(d.nbodies + 16, 0, 262144, 131072, bpi, obf, olf);
    ps->SetGravity(J::Vec3(d.gravity.x, d.gravity.y, d.gravity.z));
  }
  void put(J::BodyCreationSettings& s, const BodyDef& b) {
    s.mFriction = d.friction;
    s.mLinearDamping = s.mAngularDamping = 0;
    s.mApplyGyroscopicForce = true;
    s.mAllowSleeping = false;
    s.mMaxLinearVelocity = 2000;
    s.mMaxAngularVelocity = d.num("maxang", 190);
    if (b.ccd) s.mMotionQuality = J::EMotionQuality::LinearCast;
    if (b.dynamic) {
      s.mOverrideMassProperties = J::EOverrideMassProperties::CalculateMassAndInertia;
      s.mLinearVelocity = J::Vec3(b.lin.x, b.lin.y, b.lin.z);
      s.mAngularVelocity = J::Vec3(b.ang.x, b.ang.y, b.ang.z);
    }
    id.push_back(ps->GetBodyInterface().CreateAndAddBody(
        s, b.dynamic ? J::EActivation::Activate : J::EActivation::DontActivate));
  }
  void add(const BodyDef& b) override {
    J::Ref<J::ConvexShape> sh;
    double mn = std::min(b.half.x, std::min(b.half.y, b.half.z));
    if (b.shape == BOX)
      sh = new J::BoxShape(J::Vec3(b.half.x, b.half.y, b.half.z), std::min(0.05, mn * 0.5));
    else
      sh = new J::SphereShape(b.radius);
    sh->SetDensity(b.density);
    J::BodyCreationSettings s(
        sh, J::RVec3(b.pos.x, b.pos.y, b.pos.z), J::Quat(b.rot.x, b.rot.y, b.rot.z, b.rot.w),
        b.dynamic ? J::EMotionType::Dynamic : J::EMotionType::Static, b.dynamic ? 1 : 0);
    put(s, b);
  }
  bool addMesh(const Mesh& m) override {
    J::VertexList v;
    J::IndexedTriangleList t;
    for (size_t i = 0; i < m.v.size(); i += 3)
      v.push_back(J::Float3(m.v[i], m.v[i + 1], m.v[i + 2]));
    for (size_t i = 0; i < m.tri.size(); i += 3)
      t.push_back(J::IndexedTriangle(m.tri[i], m.tri[i + 1], m.tri[i + 2]));
    J::MeshShapeSettings ms(v, t);
    J::Ref<J::Shape> sh = ms.Create().Get();
    J::BodyCreationSettings s(sh, J::RVec3::sZero(), J::Quat::sIdentity(), J::EMotionType::Static,
                              0);
    BodyDef b;
    b.dynamic = false;
    put(s, b);
    return true;
  }
  void end() override { ps->OptimizeBroadPhase(); }
  void step(double dt) override { ps->Update((float)dt, csteps, ta.get(), js.get()); }
  State get(int i) override {
    J::BodyInterface& bi = ps->GetBodyInterfaceNoLock();
    State s;
    J::RVec3 p = bi.GetCenterOfMassPosition(id[i]);
    J::Quat q = bi.GetRotation(id[i]);
    J::Vec3 v = bi.GetLinearVelocity(id[i]), w = bi.GetAngularVelocity(id[i]);
    s.p = {p.GetX(), p.GetY(), p.GetZ()};
    s.q = {q.GetW(), q.GetX(), q.GetY(), q.GetZ()};
    s.v = {v.GetX(), v.GetY(), v.GetZ()};
    s.w = {w.GetX(), w.GetY(), w.GetZ()};
    return s;
  }
  struct CL : J::ContactListener {
    std::atomic<int> n{0};
    void OnContactAdded(const J::Body&, const J::Body&, const J::ContactManifold& m,
                        J::ContactSettings&) override {
      n += m.mRelativeContactPointsOn1.size();
    }
    void OnContactPersisted(const J::Body&, const J::Body&, const J::ContactManifold& m,
                            J::ContactSettings&) override {
      n += m.mRelativeContactPointsOn1.size();
    }
  };
  int contacts() override {
    CL l;
    ps->SetContactListener(&l);
    step(d.dt);
    ps->SetContactListener(nullptr);
    return l.n;
  }  // after all timing: one extra step
  long rays(const std::vector<V3>& o, const std::vector<V3>& r, std::vector<double>& f) override {
    const J::NarrowPhaseQuery& q = ps->GetNarrowPhaseQueryNoLock();
    long h = 0;
    for (size_t i = 0; i < o.size(); i++) {
      J::RRayCast rc(J::RVec3(o[i].x, o[i].y, o[i].z), J::Vec3(r[i].x, r[i].y, r[i].z));
      J::RayCastResult res;
      bool k = q.CastRay(rc, res);
      f[i] = k ? res.mFraction : 2;
      h += k;
    }
    return h;
  }
};
Engine* makeEngine() {
  return new EJ;
}
