#!/usr/bin/env bash
# Trees and moving boxes beside their peers in one run; lines go to stdout, tables to CSV files.
# Usage: run.sh [mesh.bin ...]   (default: the generated sphere of 20k, 200k and 1M faces)
# Needs g++, cmake, numpy and, for the peers, what is there of: Debian libembree-dev libcgal-dev
# libfcl-dev libbullet-dev (apt install), cargo for parry. A peer that cannot be built is left out
# and named. Everything is built in PEERS_BUILD; CAROM_BUILD names a finished Release build of this
# repository to take instead, EIGEN the folder that holds Eigen/Core, PYTHON one that has numpy,
# OUT the folder for trees_beside_peers.csv and moving_boxes_beside_peers.csv.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../../.." && pwd)
B=${PEERS_BUILD:-${TMPDIR:-/tmp}/peers_bvh}
eigen=${EIGEN:-/usr/include/eigen3}
python=${PYTHON:-python3}
mkdir -p "$B" && cd "$B"
out=${OUT:-$B}
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
  for mesh in "$@"; do
    for program in b_embree b_carom rust/release/rsb b_cgal; do
      [ ! -x "$program" ] || timeout 900 "./$program" "$mesh" || echo "FAILED $program on $mesh" >&2
    done
  done
  for program in b_carom rust/release/rsb broad_fcl_bullet; do
    [ ! -x "$program" ] || timeout 900 "./$program" || echo "FAILED $program on boxes" >&2
  done
} | tee lines.txt

machine="$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1) $(nproc) cores"
{
  echo "library,mesh,faces,build_ms,refit_ms,closest_million_per_s,any_million_per_s,box_million_per_s,hits,blocked,overlaps,machine,date"
  awk -F, -v OFS=, -v of="$machine,$(date -u +%F)" \
    '/^RES/ { for (i = 5; i <= 9; ++i) if ($i == 0) $i = ""  # was not asked
              sub(/^RES,/, ""); print $0, of }' lines.txt
} >"$out/trees_beside_peers.csv"
# A step is update and pairs together; ours is a mean (its work is uneven), theirs are medians.
{
  echo "library,boxes,build_ms,step_ms,worst_step_ms,pairs,machine,date"
  awk -F, -v OFS=, -v of="$machine,$(date -u +%F)" '/^BP/ {
    build = $4; sub(/build /, "", build)
    pairs = $NF; sub(/ .*/, "", pairs)
    worst = ""
    if ($5 ~ /mean/) { split($5, word, " "); step = word[5]; worst = word[7] }
    else { update = $5; sub(/.* /, "", update); of_pairs = $6; gsub(/pairs | ms/, "", of_pairs)
           step = update + of_pairs }
    print $2, $3, build, step, worst, pairs, of
  }' lines.txt
} >"$out/moving_boxes_beside_peers.csv"
echo "written: $out/trees_beside_peers.csv, $out/moving_boxes_beside_peers.csv" >&2
