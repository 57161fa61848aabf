// SPDX-License-Identifier: Apache-2.0
// Scenes, timing and accuracy figures, the same for every engine.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <memory>

#include "peer.h"

static uint64_t rs = 0x9E3779B97F4A7C15ull;
static double rnd() {  // [0,1)
  rs ^= rs << 13;
  rs ^= rs >> 7;
  rs ^= rs << 17;
  return (rs >> 11) * (1.0 / 9007199254740992.0);
}
static double rr(double a, double b) {
  return a + (b - a) * rnd();
}
static double wallNow() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
static double cpuNow() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return t.tv_sec + 1e-9 * t.tv_nsec;
}
static std::string out;
static void js(const char* k, double v) {
  char b[128];
  snprintf(b, sizeof b, "%s\"%s\": %.9g", out.empty() ? "" : ", ", k, std::isfinite(v) ? v : 1e300);
  out += b;
}
static void js(const char* k, const std::string& v) {
  out += (out.empty() ? "\"" : ", \"");
  out += k;
  out += "\": \"" + v + "\"";
}

struct Sim {
  std::unique_ptr<Engine> e{makeEngine()};
  WorldDef w;
  std::vector<BodyDef> b;
  Mesh mesh;
  std::vector<double> wall, cpu;
  void ground() {
    BodyDef g;
    g.dynamic = false;
    g.half = {100, 100, 0.5};
    g.pos = {0, 0, -0.5};
    b.push_back(g);
  }
  void start() {
    w.nbodies = (int)b.size();
    double t0 = wallNow();
    e->begin(w);
    for (auto& x : b) e->add(x);
    if (!mesh.tri.empty() && !e->addMesh(mesh)) {
      printf("{\"error\": \"no mesh support\"}\n");
      exit(0);
    }
    e->end();
    js("build_ms", 1e3 * (wallNow() - t0));
  }
  void step() {
    double a = wallNow(), c = cpuNow();
    e->step(w.dt);
    cpu.push_back(1e3 * (cpuNow() - c));
    wall.push_back(1e3 * (wallNow() - a));
  }
  void run(int n) {
    for (int i = 0; i < n; i++) step();
  }
};
static double mean(const std::vector<double>& v, size_t a, size_t n) {
  double s = 0;
  n = std::min(n, v.size() - a);
  for (size_t i = a; i < a + n; i++) s += v[i];
  return s / n;
}
static double med(std::vector<double> v, size_t a) {
  v.erase(v.begin(), v.begin() + a);
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}
static void timing(Sim& s, size_t n, size_t settled) {
  js("ms_cpu_mean", mean(s.cpu, 0, n));
  js("ms_wall_mean", mean(s.wall, 0, n));
  js("ms_wall_median", med(s.wall, 0));
  js("ms_cpu_median", med(s.cpu, 0));
  double mx = 0;
  for (double x : s.wall) mx = std::max(mx, x);
  js("ms_wall_max", mx);
  settled = std::min(settled, s.cpu.size());  // of a run that is shorter
  if (settled) {
    js("ms_cpu_settled", mean(s.cpu, s.cpu.size() - settled, settled));
    js("ms_wall_settled", med(s.wall, s.wall.size() - settled));
  }
  js("steps", (double)s.cpu.size());
}

// ---- geometric penetration between the simulated bodies, engine independent
static double boxBox(const BodyDef& A, const State& a, const BodyDef& B, const State& b) {
  V3 ax[3], bx[3];
  for (int i = 0; i < 3; i++) {
    V3 u{i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0};
    ax[i] = rotate(a.q, u);
    bx[i] = rotate(b.q, u);
  }
  double ha[3] = {A.half.x, A.half.y, A.half.z}, hb[3] = {B.half.x, B.half.y, B.half.z};
  V3 d = b.p - a.p;
  double best = 1e30;
  auto test = [&](V3 n) {
    double l = norm(n);
    if (l < 1e-6) return true;
    n = (1 / l) * n;
    double ra = 0, rb = 0;
    for (int i = 0; i < 3; i++) {
      ra += ha[i] * std::fabs(dot(n, ax[i]));
      rb += hb[i] * std::fabs(dot(n, bx[i]));
    }
    double o = ra + rb - std::fabs(dot(n, d));
    if (o <= 0) return false;
    best = std::min(best, o);
    return true;
  };
  for (int i = 0; i < 3; i++)
    if (!test(ax[i]) || !test(bx[i])) return 0;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      if (!test(cross(ax[i], bx[j]))) return 0;
  return best;
}
static double sphBox(const BodyDef& S, const State& s, const BodyDef& B, const State& b) {
  Q4 qi{b.q.w, -b.q.x, -b.q.y, -b.q.z};
  V3 l = rotate(qi, s.p - b.p);
  V3 c{std::clamp(l.x, -B.half.x, B.half.x), std::clamp(l.y, -B.half.y, B.half.y),
       std::clamp(l.z, -B.half.z, B.half.z)};
  double d = norm(l - c);
  if (d > 0) return std::max(0.0, S.radius - d);
  double m =
      std::min({B.half.x - std::fabs(l.x), B.half.y - std::fabs(l.y), B.half.z - std::fabs(l.z)});
  return S.radius + m;
}
static void quality(Sim& s) {
  size_t n = s.b.size();
  std::vector<State> st(n);
  std::vector<double> rad(n);
  double ke = 0;
  int nd = 0, bad = 0;
  for (size_t i = 0; i < n; i++) {
    st[i] = s.e->get((int)i);
    rad[i] = s.b[i].shape == BOX ? norm(s.b[i].half) : s.b[i].radius;
    if (s.b[i].dynamic) {
      nd++;
      ke += 0.5 * dot(st[i].v, st[i].v);
      if (!(std::fabs(st[i].p.z) < 1e4) || st[i].p.z < -2) bad++;
    } else {
      st[i].p = s.b[i].pos;
      st[i].q = s.b[i].rot;
    }
  }
  std::vector<int> ord;
  std::vector<int> stat;
  for (size_t i = 0; i < n; i++) (s.b[i].dynamic ? ord : stat).push_back((int)i);
  std::sort(ord.begin(), ord.end(),
            [&](int a, int b) { return st[a].p.x - rad[a] < st[b].p.x - rad[b]; });
  double worst = 0, sum = 0;
  long cnt = 0;
  auto pair = [&](int i, int j) {
    V3 d = st[i].p - st[j].p;
    if (s.b[i].dynamic && s.b[j].dynamic && norm(d) > rad[i] + rad[j]) return;
    double p;
    if (s.b[i].shape == BOX && s.b[j].shape == BOX)
      p = boxBox(s.b[i], st[i], s.b[j], st[j]);
    else if (s.b[i].shape == SPHERE && s.b[j].shape == SPHERE)
      p = std::max(0.0, s.b[i].radius + s.b[j].radius - norm(d));
    else if (s.b[i].shape == SPHERE)
      p = sphBox(s.b[i], st[i], s.b[j], st[j]);
    else
      p = sphBox(s.b[j], st[j], s.b[i], st[i]);
    if (p > 0) {
      worst = std::max(worst, p);
      sum += p;
      cnt++;
    }
  };
  for (size_t k = 0; k < ord.size(); k++) {
    int i = ord[k];
    for (size_t m = k + 1; m < ord.size(); m++) {
      int j = ord[m];
      if (st[j].p.x - rad[j] > st[i].p.x + rad[i]) break;
      pair(i, j);
    }
    for (int j : stat) pair(i, j);
  }
  js("pen_max_mm", 1e3 * worst);
  js("pen_mean_mm", cnt ? 1e3 * sum / cnt : 0);
  js("overlapping_pairs", (double)cnt);
  js("mean_v2_half", ke / std::max(1, nd));
  js("lost", bad);
}

// Shapes and where the engine has them now, for pictures: one CSV row a body.
static void dump(Sim& s, const std::string& path) {
  FILE* f = fopen(path.c_str(), "w");
  if (!f) {
    fprintf(stderr, "cannot write %s\n", path.c_str());
    _Exit(2);
  }
  fprintf(f, "shape,moves,density,size_x,size_y,size_z,x,y,z,qx,qy,qz,qw\n");
  for (size_t i = 0; i < s.b.size(); i++) {
    const BodyDef& b = s.b[i];
    State t = b.dynamic ? s.e->get((int)i) : State{b.pos, b.rot, {}, {}};
    V3 size = b.shape == BOX ? 2.0 * b.half : V3{2 * b.radius, 2 * b.radius, 2 * b.radius};
    fprintf(f, "%s,%d,%g,%g,%g,%g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n",
            b.shape == BOX ? "box" : "sphere", b.dynamic, b.density, size.x, size.y, size.z, t.p.x,
            t.p.y, t.p.z, t.q.x, t.q.y, t.q.z, t.q.w);
  }
  fclose(f);
}

static double terrainZ(double x, double y) {
  return 1.0 * std::sin(0.35 * x) * std::cos(0.3 * y) + 0.3 * std::sin(1.1 * x + 0.5 * y);
}
static Mesh terrain(int cells) {
  Mesh m;
  m.size = 60;
  m.nx = m.ny = cells + 1;
  double h = m.size / cells;
  for (int j = 0; j <= cells; j++)
    for (int i = 0; i <= cells; i++) {
      double x = -30 + i * h, y = -30 + j * h;
      m.v.insert(m.v.end(), {x, y, terrainZ(x, y)});
    }
  for (int j = 0; j < cells; j++)
    for (int i = 0; i < cells; i++) {
      int a = j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
      for (int t : {a, b, d, a, d, c}) m.tri.push_back(t);
    }
  return m;
}
static void inertia(const BodyDef& b, double& m, V3& I) {
  V3 h = b.half;
  m = b.density * 8 * h.x * h.y * h.z;
  I = {m / 3 * (h.y * h.y + h.z * h.z), m / 3 * (h.x * h.x + h.z * h.z),
       m / 3 * (h.x * h.x + h.y * h.y)};
}
static V3 toBody(Q4 q, V3 v) {
  return rotate({q.w, -q.x, -q.y, -q.z}, v);
}

int main(int argc, char** argv) {
  std::map<std::string, std::string> o;
  for (int i = 1; i + 1 < argc; i += 2) o[argv[i] + 2] = argv[i + 1];
  auto S = [&](const char* k, const char* d) { return o.count(k) ? o[k] : std::string(d); };
  auto N = [&](const char* k, double d) { return o.count(k) ? std::stod(o[k]) : d; };
  Sim s;
  s.w.opt = o;
  s.w.dt = 1.0 / N("hz", 60);
  s.w.threads = (int)N("threads", 1);
  std::string sc = S("scene", "pile");
  int n = (int)N("n", 1000);
  int steps = (int)N("steps", 0);
  double hz = N("hz", 60);
  auto& b = s.b;

  if (sc == "free") {
    int k = (int)std::ceil(std::cbrt((double)n));
    for (int i = 0; i < n; i++) {
      BodyDef d;
      d.half = {rr(.1, .4), rr(.1, .4), rr(.1, .4)};
      d.pos = {5.0 * (i % k), 5.0 * (i / k % k), 5.0 * (i / k / k) + 100};
      d.lin = {rr(-.5, .5), rr(-.5, .5), rr(-.5, .5)};
      d.ang = {rr(-5, 5), rr(-5, 5), rr(-5, 5)};
      b.push_back(d);
    }
    s.start();
    s.run(steps ? steps : (int)(2 * hz));
    timing(s, 1u << 30, 60);
    double T = s.cpu.size() * s.w.dt, perr = 0, er = 0, lr = 0;
    for (int i = 0; i < n; i++) {
      State t = s.e->get(i);
      V3 ex = b[i].pos + T * b[i].lin + 0.5 * T * T * s.w.gravity;
      perr = std::max(perr, norm(t.p - ex));
      double m;
      V3 I;
      inertia(b[i], m, I);
      V3 w0 = b[i].ang, w1 = toBody(t.q, t.w);
      auto E = [&](V3 w) { return I.x * w.x * w.x + I.y * w.y * w.y + I.z * w.z * w.z; };
      er = std::max(er, std::fabs(E(w1) / E(w0) - 1));
      V3 L0{I.x * w0.x, I.y * w0.y, I.z * w0.z},
          L1 = rotate(t.q, {I.x * w1.x, I.y * w1.y, I.z * w1.z});
      lr = std::max(lr, norm(L1 - L0) / norm(L0));
    }
    js("pos_err_max_m", perr);
    js("rot_energy_err_max", er);
    js("ang_mom_err_max", lr);
  } else if (sc == "pile" || sc == "grid") {
    // pile: random orientations, ends as a heap; grid: axis aligned columns that a good solver
    // keeps standing
    s.ground();
    int k = n <= 1000 ? 10 : 17;
    double sp = sc == "pile" ? 0.7 : 0.6;
    for (int i = 0; i < n; i++) {
      BodyDef d;
      d.pos = {sp * (i % k - 0.5 * k) + rr(-.02, .02), sp * (i / k % k - 0.5 * k) + rr(-.02, .02),
               0.3 + 0.55 * (i / k / k)};
      if (sc == "pile") {
        Q4 q{rr(-1, 1), rr(-1, 1), rr(-1, 1), rr(-1, 1)};
        double m = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
        d.rot = {q.w / m, q.x / m, q.y / m, q.z / m};
        d.pos.z = 0.5 + 0.75 * (i / k / k);
      }
      b.push_back(d);
    }
    s.start();
    int st = steps ? steps : (int)(5 * hz);
    s.run(st + (int)(100));
    timing(s, st, 100);
    quality(s);
  } else if (sc == "pyramid") {
    s.ground();
    int top = 0;
    for (int i = 0; i < n; i++)
      for (int j = 0; j < n - i; j++) {
        BodyDef d;
        d.half = {.5, .5, .5};
        d.pos = {1.02 * (j - 0.5 * (n - i - 1)), 0, 0.5 + i};
        top = (int)b.size();
        b.push_back(d);
      }
    s.start();
    s.run(steps ? steps : (int)(10 * hz));
    timing(s, 1u << 30, 100);
    V3 d = s.e->get(top).p - b[top].pos;
    js("top_drift_mm", 1e3 * std::hypot(d.x, d.y));
    js("top_sink_mm", -1e3 * d.z);
    quality(s);
  } else if (sc == "spheres") {
    int k = n <= 2000 ? 13 : 22;
    double L = 0.3 * k + 0.15;
    s.ground();
    for (int q = 0; q < 4; q++) {
      BodyDef d;
      d.dynamic = false;
      d.half = {q < 2 ? .25 : L + .5, q < 2 ? L + .5 : .25, 15};
      d.pos = {q == 0   ? L + .25
               : q == 1 ? -L - .25
                        : 0,
               q == 2   ? L + .25
               : q == 3 ? -L - .25
                        : 0,
               15};
      b.push_back(d);
    }
    for (int i = 0; i < n; i++) {
      BodyDef d;
      d.shape = SPHERE;
      d.pos = {0.6 * (i % k - 0.5 * (k - 1)) + rr(-.02, .02),
               0.6 * (i / k % k - 0.5 * (k - 1)) + rr(-.02, .02), 0.3 + 0.55 * (i / k / k)};
      b.push_back(d);
    }
    s.start();
    int st = steps ? steps : (int)(5 * hz);
    s.run(st + 100);
    timing(s, st, 100);
    quality(s);
  } else if (sc == "stack") {
    double ratio = N("ratio", 1);
    s.ground();
    int top = 0;
    for (int i = 0; i < n; i++) {
      BodyDef d;
      d.pos = {0, 0, 0.25 + 0.5 * i};
      if (i == n - 1) d.density *= ratio;
      top = (int)b.size();
      b.push_back(d);
    }
    s.start();
    s.run(steps ? steps : (int)(10 * hz));
    timing(s, 1u << 30, 100);
    V3 d = s.e->get(top).p - b[top].pos;
    js("top_drift_mm", 1e3 * std::hypot(d.x, d.y));
    js("top_sink_mm", -1e3 * d.z);
    js("stands", std::hypot(d.x, d.y) < 0.25 && std::fabs(d.z) < 0.25);
    quality(s);
  } else if (sc == "bullet") {
    double v = N("speed", 300);
    s.w.ccd = S("ccd", "1") == "1";
    s.w.gravity = {};
    bool rod = S("kind", "sphere") == "rod";
    BodyDef wl;
    wl.dynamic = false;
    wl.half = {.005, 2, 2};
    b.push_back(wl);
    BodyDef d;
    d.ccd = s.w.ccd;
    if (rod) {
      d.half = {.02, .5, .02};
      d.pos = {-.3, 0, 0};
      d.lin = {v, 0, 0};
      d.ang = {0, 0, N("spin", 100)};
    } else {
      d.shape = SPHERE;
      d.radius = .05;
      d.pos = {-5.37, 0.03, 0.02};
      d.lin = {v, 0, 0};
    }
    b.push_back(d);
    s.start();
    double pen = 0;
    bool thru = false;
    for (int i = 0; i < (int)(1 * hz); i++) {
      s.step();
      State t = s.e->get(1);
      double mx = t.p.x + (rod ? 0 : d.radius);
      if (rod)
        for (int c = 0; c < 8; c++) {
          V3 p = t.p + rotate(t.q, {c & 1 ? .02 : -.02, c & 2 ? .5 : -.5, c & 4 ? .02 : -.02});
          mx = std::max(mx, p.x);
        }
      if (t.p.x > 0.005) thru = true;
      if (!thru) pen = std::max(pen, mx + .005);
    }
    timing(s, 1u << 30, 0);
    State t = s.e->get(1);
    js("tunnelled", thru);
    js("pen_max_mm", 1e3 * pen);
    js("x_end", t.p.x);
    js("vx_end", t.v.x);
    js("wz_end", t.w.z);
  } else if (sc == "torquefree") {
    s.w.gravity = {};
    BodyDef d;
    d.half = {0.5 * std::sqrt(2.5), 0.5 * std::sqrt(1.5), 0.5 * std::sqrt(0.5)};
    d.ang = {0.01, 5, 0.01};
    if (S("axis", "mid") == "gen") d.ang = {2, 3, 1.5};
    b.push_back(d);
    s.start();
    double m;
    V3 I;
    inertia(d, m, I);
    // reference: RK4 on (q, body omega) with 1e-4 s steps (error far below the engines')
    Q4 q = d.rot;
    V3 w = d.ang;
    const double h = 1e-4;
    auto fw = [&](V3 w) {
      return V3{(I.y - I.z) / I.x * w.y * w.z, (I.z - I.x) / I.y * w.z * w.x,
                (I.x - I.y) / I.z * w.x * w.y};
    };
    auto fq = [&](Q4 q, V3 w) {
      return Q4{.5 * (-q.x * w.x - q.y * w.y - q.z * w.z), .5 * (q.w * w.x + q.y * w.z - q.z * w.y),
                .5 * (q.w * w.y - q.x * w.z + q.z * w.x), .5 * (q.w * w.z + q.x * w.y - q.y * w.x)};
    };
    auto ad = [](Q4 a, double s, Q4 b) {
      return Q4{a.w + s * b.w, a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
    };
    long refn = 0;
    auto advance = [&](double T) {
      for (; refn < std::llround(T / h); refn++) {
        V3 k1 = fw(w), k2 = fw(w + .5 * h * k1), k3 = fw(w + .5 * h * k2), k4 = fw(w + h * k3);
        Q4 a = fq(q, w), bq = fq(ad(q, .5 * h, a), w + .5 * h * k1),
           c = fq(ad(q, .5 * h, bq), w + .5 * h * k2), e = fq(ad(q, h, c), w + h * k3);
        w = w + (h / 6) * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        q = ad(ad(ad(ad(q, h / 6, a), h / 3, bq), h / 3, c), h / 6, e);
        double nn = 1 / std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
        q = {q.w * nn, q.x * nn, q.y * nn, q.z * nn};
      }
    };
    V3 w0 = d.ang;
    double E0 = I.x * w0.x * w0.x + I.y * w0.y * w0.y + I.z * w0.z * w0.z;
    V3 L0{I.x * w0.x, I.y * w0.y, I.z * w0.z};
    double emax = 0, lmax = 0;
    for (int i = 1; i <= (int)(100 * hz); i++) {
      s.step();
      State t = s.e->get(0);
      V3 wb = toBody(t.q, t.w);
      double E = I.x * wb.x * wb.x + I.y * wb.y * wb.y + I.z * wb.z * wb.z;
      V3 L = rotate(t.q, {I.x * wb.x, I.y * wb.y, I.z * wb.z});
      emax = std::max(emax, std::fabs(E / E0 - 1));
      lmax = std::max(lmax, norm(L - L0) / norm(L0));
      for (double T : {1.0, 10.0, 100.0})
        if (i == (int)(T * hz)) {
          advance(T);
          double c = std::fabs(q.w * t.q.w + q.x * t.q.x + q.y * t.q.y + q.z * t.q.z);
          char k[32];
          snprintf(k, sizeof k, "ang_err_%ds_rad", (int)T);
          js(k, 2 * std::acos(std::min(1.0, c)));
          snprintf(k, sizeof k, "energy_%ds", (int)T);
          js(k, E / E0 - 1);
        }
    }
    js("energy_drift_max", emax);
    js("ang_mom_drift_max", lmax);
    js("ms_cpu_mean", mean(s.cpu, 0, 1u << 30));
  } else if (sc == "mesh" || sc == "rays") {
    int cells = n;
    s.mesh = terrain(cells);
    if (sc == "mesh") {
      int nb = (int)N("bodies", 500);
      std::string kind = S("kind", "mix");
      for (int i = 0; i < nb; i++) {
        BodyDef d;
        d.shape = kind == "box" ? BOX : kind == "sphere" ? SPHERE : i & 1 ? SPHERE : BOX;
        d.pos = {1.2 * (i % 25 - 12) + rr(-.1, .1), 1.2 * (i / 25 - 10) + rr(-.1, .1), 2.5};
        b.push_back(d);
      }
      s.start();
      int st = steps ? steps : (int)(5 * hz);
      s.run(st + 100);
      timing(s, st, 100);
      int lost = 0;
      double low = 0, ke = 0;
      for (int i = 0; i < nb; i++) {
        State t = s.e->get(i);
        double g = t.p.z - terrainZ(t.p.x, t.p.y);
        if (g < -0.05 || !(std::fabs(t.p.x) < 30 && std::fabs(t.p.y) < 30)) lost++;
        low = std::min(low, g);
        ke += .5 * dot(t.v, t.v);
      }
      js("lost", lost);
      js("mean_v2_half", ke / nb);
      js("tris", cells * cells * 2.0);
    } else {
      BodyDef d;
      d.pos = {0, 0, 60};
      b.push_back(d);  // one dynamic body far above: some engines want one
      s.start();
      s.step();
      int nr = (int)N("rays", 200000);
      std::vector<V3> ro(nr), rd(nr);
      std::vector<double> f(nr, 2);
      for (int i = 0; i < nr; i++) {
        ro[i] = {rr(-29, 29), rr(-29, 29), rr(2, 10)};
        V3 e{ro[i].x + rr(-15, 15), ro[i].y + rr(-15, 15), -6};
        rd[i] = e - ro[i];
      }
      s.e->rays(ro, rd, f);
      double a = wallNow(), c = cpuNow();
      long hits = s.e->rays(ro, rd, f);
      double dc = cpuNow() - c, dw = wallNow() - a;
      double sf = 0;
      for (int i = 0; i < nr; i++)
        if (f[i] <= 1) sf += f[i];
      js("hits", (double)hits);
      js("mean_frac", hits > 0 ? sf / hits : 0);
      js("rays_per_s_cpu", hits < 0 ? 0 : nr / dc);
      js("rays_per_s_wall", hits < 0 ? 0 : nr / dw);
      js("tris", cells * cells * 2.0);
    }
  }
  if (o.count("dump")) dump(s, o["dump"]);
  js("contacts", s.e->contacts());  // last: one adaptor needs an extra step to count
  js("engine", s.e->name());
  js("settings", s.e->settings());
  js("scene", sc);
  js("n", n);
  js("hz", hz);
  js("threads", s.w.threads);
  printf("{%s}\n", out.c_str());
  fflush(stdout);
  _Exit(0);
}
