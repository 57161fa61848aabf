#!/usr/bin/env bash
# Trees beside their peers in one run: builds what is available, then prints RES and BP lines.
# Usage: run.sh [mesh.bin ...]   (default: the generated sphere of 20k, 200k and 1M faces)
# Debian: libembree-dev libcgal-dev libfcl-dev libbullet-dev; Rust for parry; numpy for the meshes.
# CAROM_BUILD names a Release build of this repository, EIGEN the folder that holds Eigen/Core.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../../.." && pwd)
B=${PEERS_BUILD:-${TMPDIR:-/tmp}/peers_bvh}
carom=${CAROM_BUILD:-$root/build/release}
eigen=${EIGEN:-/usr/include/eigen3}
mkdir -p "$B" && cd "$B"
[ -f sphere_1m.bin ] || python3 "$here/gen_meshes.py"
cxx="g++ -O3 -march=native -DNDEBUG -I$here"
try() { echo "building $1" >&2; shift; "$@" || echo "skipped: $*" >&2; }
try carom $cxx -std=c++20 -ffp-contract=off -I"$root/cpp/include" -isystem "$eigen" \
  "$here/b_carom.cpp" "$carom/libcarom.a" -o b_carom
try embree $cxx -std=c++17 "$here/b_embree.cpp" -lembree3 -o b_embree
try cgal $cxx -std=c++17 "$here/b_cgal.cpp" -lgmp -lmpfr -o b_cgal
try fcl_bullet $cxx -std=c++17 -isystem "$eigen" -I/usr/include/bullet "$here/broad_fcl_bullet.cpp" \
  -lfcl -lccd -lBulletCollision -lLinearMath -o broad_fcl_bullet
rm -rf rust_source && cp -r "$here/rust" rust_source
try parry cargo build --release --quiet --manifest-path rust_source/Cargo.toml --target-dir rust
[ $# -gt 0 ] || set -- sphere_20k.bin sphere_200k.bin sphere_1m.bin
echo "RES,library,mesh,faces,build ms,refit ms,closest M/s,any M/s,box M/s,hits,blocked,overlaps"
for mesh in "$@"; do
  for program in b_embree b_carom rust/release/rsb b_cgal; do
    [ -x "$program" ] && timeout 900 "./$program" "$mesh" || true
  done
done
for program in b_carom rust/release/rsb broad_fcl_bullet; do
  [ -x "$program" ] && timeout 900 "./$program" || true
done
