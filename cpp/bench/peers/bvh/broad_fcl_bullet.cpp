// dynamic broad phase: moving AABBs; Bullet (btDbvtBroadphase, btAxisSweep3), FCL managers
#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fcl/broadphase/broadphase_SaP.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>
#include <fcl/broadphase/broadphase_interval_tree.h>
#include <fcl/geometry/shape/box.h>
#include <memory>
#include <time.h>
#include <vector>
static double now() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return t.tv_sec + 1e-9 * t.tv_nsec;
}
struct R {
  uint64_t s = 0x9E3779B97F4A7C15ull;
  double u() {
    s ^= s << 13;
    s ^= s >> 7;
    s ^= s << 17;
    return (s >> 11) * 0x1p-53;
  }
};
struct W {
  int n;
  double L;
  std::vector<double> c, v, h;
  W(int n_) : n(n_) {
    R r;
    L = std::cbrt(n * 4.0);
    for (int i = 0; i < n; i++) {
      for (int d = 0; d < 3; d++) {
        c.push_back(r.u() * L);
        v.push_back((r.u() - .5) * .1);
        h.push_back(.3 + .4 * r.u());
      }
    }
  }
  void step() {
    for (int i = 0; i < 3 * n; i++) {
      c[i] += v[i];
      if (c[i] < 0 || c[i] > L) v[i] = -v[i];
    }
  }
};
static double md(std::vector<double> t) {
  std::sort(t.begin(), t.end());
  return t[t.size() / 2];
}
template <class M>
void fc(const char* nm, int n, int steps) {
  W w(n);
  M m;
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> o;
  for (int i = 0; i < n; i++) {
    auto g = std::make_shared<fcl::Boxd>(2 * w.h[3 * i], 2 * w.h[3 * i + 1], 2 * w.h[3 * i + 2]);
    fcl::Transform3d T = fcl::Transform3d::Identity();
    T.translation() << w.c[3 * i], w.c[3 * i + 1], w.c[3 * i + 2];
    o.emplace_back(new fcl::CollisionObjectd(g, T));
    o.back()->computeAABB();
    m.registerObject(o.back().get());
  }
  double t0 = now();
  m.setup();
  double tb = now() - t0;
  std::vector<double> tu, tq;
  size_t pairs = 0;
  for (int s = 0; s < steps; s++) {
    w.step();
    for (int i = 0; i < n; i++) {
      o[i]->setTranslation(Eigen::Vector3d(w.c[3 * i], w.c[3 * i + 1], w.c[3 * i + 2]));
      o[i]->computeAABB();
    }
    double a = now();
    m.update();
    double b = now();
    pairs = 0;
    m.collide(&pairs, [](fcl::CollisionObjectd* x, fcl::CollisionObjectd* y, void* d) {
      if (x->getAABB().overlap(y->getAABB())) ++*(size_t*)d;
      return false;
    });
    double c = now();
    tu.push_back(b - a);
    tq.push_back(c - b);
  }
  printf("BP,%s,%d,build %.3f,update %.3f,pairs %.3f ms,%zu\n", nm, n, tb * 1e3, md(tu) * 1e3,
         md(tq) * 1e3, pairs);
  fflush(stdout);
}
template <class B>
void bt(const char* nm, int n, int steps, B* bp) {
  W w(n);
  std::vector<btBroadphaseProxy*> p(n);
  auto bx = [&](int i, btVector3& lo, btVector3& hi) {
    lo.setValue(w.c[3 * i] - w.h[3 * i], w.c[3 * i + 1] - w.h[3 * i + 1],
                w.c[3 * i + 2] - w.h[3 * i + 2]);
    hi.setValue(w.c[3 * i] + w.h[3 * i], w.c[3 * i + 1] + w.h[3 * i + 1],
                w.c[3 * i + 2] + w.h[3 * i + 2]);
  };
  double t0 = now();
  for (int i = 0; i < n; i++) {
    btVector3 a, b;
    bx(i, a, b);
    p[i] = bp->createProxy(a, b, 0, (void*)(size_t)(i + 1), 1, 1, nullptr);
  }
  bp->calculateOverlappingPairs(nullptr);
  double tb = now() - t0;
  std::vector<double> tu, tq;
  for (int s = 0; s < steps; s++) {
    w.step();
    double t = now();
    for (int i = 0; i < n; i++) {
      btVector3 a, b;
      bx(i, a, b);
      bp->setAabb(p[i], a, b, nullptr);
    }
    double t2 = now();
    bp->calculateOverlappingPairs(nullptr);
    double t3 = now();
    tu.push_back(t2 - t);
    tq.push_back(t3 - t2);
  }
  printf("BP,%s(scalar %zuB),%d,build %.3f,update %.3f,pairs %.3f ms,%d (persistent cache)\n", nm,
         sizeof(btScalar), n, tb * 1e3, md(tu) * 1e3, md(tq) * 1e3,
         bp->getOverlappingPairCache()->getNumOverlappingPairs());
  fflush(stdout);
}
int main() {
  for (int n : {10000, 100000}) {
    int st = n > 50000 ? 3 : 7;
    fc<fcl::DynamicAABBTreeCollisionManagerd>("fcl-dynAABB", n, st);
    {
      btDbvtBroadphase b;
      bt("bullet-dbvt", n, st, &b);
    }
    if (n <= 10000) {
      W w(n);
      bt32BitAxisSweep3 b(btVector3(-5, -5, -5), btVector3(w.L + 5, w.L + 5, w.L + 5), n + 10);
      bt("bullet-axissweep3", n, st, &b);
    }
  }
}
