#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include "common.h"
typedef CGAL::Simple_cartesian<double> K;
typedef K::Point_3 P;
typedef K::Triangle_3 T;
typedef std::vector<T>::iterator It;
typedef CGAL::AABB_triangle_primitive<K, It> Pr;
typedef CGAL::AABB_tree<CGAL::AABB_traits<K, Pr>> Tree;
int main(int c, char** v) {
  for (int i = 1; i < c; i++) {
    Mesh m = load(v[i]);
    size_t n = m.f.size();
    std::vector<T> t;
    auto p = [&](int k) { return P(m.v[k][0], m.v[k][1], m.v[k][2]); };
    for (auto& f : m.f) t.emplace_back(p(f[0]), p(f[1]), p(f[2]));
    Tree tr;
    double tb = med(3, [&] {
      tr.clear();
      tr.insert(t.begin(), t.end());
      tr.build();
    });
    auto rq = rays(m, NR / 4);
    size_t hc = 0, ha = 0, hb = 0;
    double tc = med(3, [&] {
      hc = 0;
      for (auto& r : rq) {
        K::Ray_3 y(P(r.o[0], r.o[1], r.o[2]), K::Vector_3(r.d[0], r.d[1], r.d[2]));
        auto h = tr.first_intersected_primitive(y);
        hc += (bool)h;
      }
    });
    double ta = med(3, [&] {
      ha = 0;
      for (auto& r : rq) {
        K::Segment_3 y(
            P(r.o[0], r.o[1], r.o[2]),
            P(r.o[0] + r.d[0] * r.len, r.o[1] + r.d[1] * r.len, r.o[2] + r.d[2] * r.len));
        ha += tr.do_intersect(y);
      }
    });
    auto bq = boxes(m, NB / 4);
    double tx = med(3, [&] {
      hb = 0;
      std::vector<Tree::Primitive_id> o;
      for (auto& b : bq) {
        o.clear();
        tr.all_intersected_primitives(
            CGAL::Bbox_3(b.lo[0], b.lo[1], b.lo[2], b.hi[0], b.hi[1], b.hi[2]),
            std::back_inserter(o));
        hb += o.size();
      }
    });
    out("cgal-f64(ray not seg)", v[i], n, tb, 0, (NR / 4) / tc, (NR / 4) / ta, (NB / 4) / tx, hc,
        ha, hb);
  }
}
