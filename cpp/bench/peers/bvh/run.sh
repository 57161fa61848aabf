#!/usr/bin/env bash
# Trees and moving boxes beside their peers in one run; the table goes to stdout and to a CSV file.
# Usage: run.sh [mesh.bin ...]   (default: the generated sphere of 20k, 200k and 1M faces)
# Needs g++, cmake, numpy and, for the peers, what is there of: Debian libembree-dev libcgal-dev
# libfcl-dev libbullet-dev (apt install), cargo for parry. A peer that cannot be built is left out
# and named. Everything is built in PEERS_BUILD; CAROM_BUILD names a finished Release build of this
# repository to take instead, EIGEN the folder that holds Eigen/Core, PYTHON one that has numpy,
# CSV the file to write.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../../.." && pwd)
B=${PEERS_BUILD:-${TMPDIR:-/tmp}/peers_bvh}
eigen=${EIGEN:-/usr/include/eigen3}
python=${PYTHON:-python3}
mkdir -p "$B" && cd "$B"
csv=${CSV:-$B/trees_beside_peers.csv}
if [ -z "${CAROM_BUILD:-}" ]; then
  CAROM_BUILD=$B/carom
  CMAKE_PREFIX_PATH=${CMAKE_PREFIX_PATH:-} cmake -S "$root" -B "$CAROM_BUILD" \
    -DCMAKE_BUILD_TYPE=Release -DCAROM_BUILD_TESTS=OFF >&2
  cmake --build "$CAROM_BUILD" --target carom -j "$(nproc)" >&2
fi
[ -f sphere_1m.bin ] || "$python" "$here/gen_meshes.py" >&2

# Left of an earlier run, a program must not stand in for one that no longer builds.
rm -f b_carom b_embree b_cgal broad_fcl_bullet rust/release/rsb
cxx="g++ -O3 -march=native -DNDEBUG -I$here"
try() {
  local name=$1
  shift
  echo "building $name" >&2
  "$@" >"$name.log" 2>&1 || echo "LEFT OUT: $name, see $B/$name.log" >&2
}
try carom $cxx -std=c++20 -ffp-contract=off -I"$root/cpp/include" -isystem "$eigen" \
  "$here/b_carom.cpp" "$CAROM_BUILD/libcarom.a" -o b_carom
try embree $cxx -std=c++17 "$here/b_embree.cpp" -lembree3 -o b_embree
try cgal $cxx -std=c++17 "$here/b_cgal.cpp" -lgmp -lmpfr -o b_cgal
try fcl_bullet $cxx -std=c++17 -isystem "$eigen" -I/usr/include/bullet "$here/broad_fcl_bullet.cpp" \
  -lfcl -lccd -lBulletCollision -lLinearMath -o broad_fcl_bullet
rm -rf rust_source && cp -r "$here/rust" rust_source
try parry cargo build --release --manifest-path rust_source/Cargo.toml --target-dir rust -j 2

[ $# -gt 0 ] || set -- sphere_20k.bin sphere_200k.bin sphere_1m.bin
{
  echo "# $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), $(nproc) cores, $(date -u +%F)," \
    "carom $(git -C "$root" describe --always --dirty 2>/dev/null || echo unknown)"
  echo "# RES,library,mesh,faces,build ms,refit ms,closest M/s,any M/s,box M/s,hits,blocked,overlaps"
  echo "# BP,library,boxes,build ms,a step (update and pairs) ms,pairs"
  for mesh in "$@"; do
    for program in b_embree b_carom rust/release/rsb b_cgal; do
      [ ! -x "$program" ] || timeout 900 "./$program" "$mesh" || echo "# $program failed on $mesh"
    done
  done
  for program in b_carom rust/release/rsb broad_fcl_bullet; do
    [ ! -x "$program" ] || timeout 900 "./$program" || echo "# $program failed on moving boxes"
  done
} | tee "$csv"
echo "written: $csv" >&2
