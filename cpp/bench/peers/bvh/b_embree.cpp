#include <embree3/rtcore.h>

#include "common.h"
int main(int c, char** v) {
  for (int i = 1; i < c; i++) {
    Mesh m = load(v[i]);
    size_t n = m.f.size();
    RTCDevice dev = rtcNewDevice("threads=1,set_affinity=0");
    int reps = n > 500000 ? 3 : 5;
    struct Cfg {
      const char* n;
      RTCBuildQuality q;
      RTCSceneFlags f;
    } cf[] = {{"embree3-f32-low(morton)", RTC_BUILD_QUALITY_LOW, RTC_SCENE_FLAG_DYNAMIC},
              {"embree3-f32-med", RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_NONE},
              {"embree3-f32-robust", RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_ROBUST}};
    for (auto& q : cf) {
      RTCScene s = nullptr;
      double tb = med(reps, [&] {
        if (s) rtcReleaseScene(s);
        s = rtcNewScene(dev);
        rtcSetSceneFlags(s, q.f);
        rtcSetSceneBuildQuality(s, q.q);
        RTCGeometry g = rtcNewGeometry(dev, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetGeometryBuildQuality(g, q.q);
        float* V = (float*)rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                   12, m.v.size());
        for (size_t k = 0; k < m.v.size(); k++)
          for (int d = 0; d < 3; d++) V[3 * k + d] = m.v[k][d];
        int* F =
            (int*)rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, n);
        memcpy(F, m.f.data(), 12 * n);
        rtcCommitGeometry(g);
        rtcAttachGeometry(s, g);
        rtcReleaseGeometry(g);
        rtcCommitScene(s);
      });
      double trf = 0;
      if (q.f == RTC_SCENE_FLAG_DYNAMIC) {
        RTCGeometry g = rtcGetGeometry(s, 0);
        rtcSetGeometryBuildQuality(g, RTC_BUILD_QUALITY_REFIT);
        rtcCommitGeometry(g);
        rtcCommitScene(s);
        trf = med(reps, [&] {
          rtcUpdateGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0);
          rtcCommitGeometry(g);
          rtcCommitScene(s);
        });
      }
      auto rq = rays(m, NR);
      size_t hc = 0, ha = 0, hb = 0;
      RTCIntersectContext cx;
      rtcInitIntersectContext(&cx);
      double tc = med(5, [&] {
        hc = 0;
        for (auto& r : rq) {
          RTCRayHit h;
          h.ray.org_x = r.o[0];
          h.ray.org_y = r.o[1];
          h.ray.org_z = r.o[2];
          h.ray.dir_x = r.d[0];
          h.ray.dir_y = r.d[1];
          h.ray.dir_z = r.d[2];
          h.ray.tnear = 0;
          h.ray.tfar = r.len;
          h.ray.time = 0;
          h.ray.mask = -1;
          h.ray.flags = 0;
          h.hit.geomID = RTC_INVALID_GEOMETRY_ID;
          h.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
          rtcIntersect1(s, &cx, &h);
          hc += h.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        }
      });
      double ta = med(5, [&] {
        ha = 0;
        for (auto& r : rq) {
          RTCRay h;
          h.org_x = r.o[0];
          h.org_y = r.o[1];
          h.org_z = r.o[2];
          h.dir_x = r.d[0];
          h.dir_y = r.d[1];
          h.dir_z = r.d[2];
          h.tnear = 0;
          h.tfar = r.len;
          h.time = 0;
          h.mask = -1;
          h.flags = 0;
          rtcOccluded1(s, &cx, &h);
          ha += h.tfar < 0;
        }
      });
      out(q.n, v[i], n, tb, trf, NR / tc, NR / ta, 0, hc, ha, hb);
      rtcReleaseScene(s);
    }
    rtcReleaseDevice(dev);
  }
}
