#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds every peer from registry packages. Usage: build.sh [engine ...]
#   engines: own box3d jolt rapier bullet ode mujoco physx   (default: all)
# Artefacts go under $PEERS_BUILD (default ${TMPDIR:-/tmp}/peers), never into the repository.
# Debian packages wanted: g++ cmake libbullet-dev libode-dev; Rust toolchain; python3-venv.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
B=${PEERS_BUILD:-${TMPDIR:-/tmp}/peers}
ARCH=${PEERS_ARCH:-x86-64-v3}
J=${PEERS_JOBS:-2}
mkdir -p "$B/bin" "$B/build"
want=${*:-own box3d jolt rapier bullet ode mujoco physx}
has() { [[ " $want " == *" $1 "* ]]; }
CXX="g++ -std=c++17 -O3 -march=$ARCH"

if has box3d || has jolt || has physx; then
  [ -d "$B/vendor" ] || { mkdir -p "$B/fetch"; cp -r "$here/fetch/." "$B/fetch/"; (cd "$B/fetch" && cargo vendor -q --versioned-dirs "$B/vendor"); }
fi
$CXX -c "$here/src/driver.cpp" -o "$B/build/driver.o"

if has own; then  # the defaults a user gets: no -march, CPU level chosen at run time
  root=$(cd "$here/../../.." && pwd)
  d=$B/build/own
  cmake -S "$root" -B "$d" -DCMAKE_BUILD_TYPE=Release -DCAROM_BUILD_TESTS=OFF -DCAROM_BUILD_EXAMPLES=OFF ${PEERS_CMAKE_ARGS:-}
  cmake --build "$d" -j"$J" --target carom
  eigen=$(sed -n 's/^Eigen3_DIR:[A-Z]*=\(.*\)\/share\/eigen3\/cmake$/\1\/include\/eigen3/p' "$d/CMakeCache.txt")
  g++ -std=c++20 -O3 -I"$root/cpp/include" -isystem "${eigen:-/usr/include/eigen3}" "$here/src/own.cpp" "$B/build/driver.o" "$d/libcarom.a" -lpthread -o "$B/bin/own"
fi
if has box3d; then
  V=$(echo "$B"/vendor/box3d-sys-*/vendor/box3d)
  for p in f32 f64; do for m in sse2 v3; do
    d=$B/build/box3d_${p}_$m; mkdir -p "$d"; fl="-O3 -DNDEBUG -ffp-contract=off -std=gnu17 -I$V/include -I$V/src"
    [ $m = v3 ] && fl="$fl -march=$ARCH"; [ $p = f64 ] && fl="$fl -DBOX3D_DOUBLE_PRECISION"
    [ -f "$d/libbox3d.a" ] || (cd "$d" && ls "$V"/src/*.c | xargs -P"$J" -n4 gcc -c $fl && ar rcs libbox3d.a *.o)
    $CXX $([ $p = f64 ] && echo -DBOX3D_DOUBLE_PRECISION) -I"$V/include" "$here/src/box3d.cpp" "$B/build/driver.o" "$d/libbox3d.a" -lpthread -lm -o "$B/bin/box3d_${p}_$m"
  done; done
fi
if has jolt; then
  V=$(echo "$B"/vendor/joltc-sys-*/JoltC/JoltPhysics)
  for p in f32 f64; do
    d=$B/build/jolt_$p; [ $p = f64 ] && dp=ON || dp=OFF; [ $p = f64 ] && [ "${PEERS_JOLT_F64:-0}" = 0 ] && continue
    if [ ! -f "$d/libJolt.a" ]; then
      cmake -S "$V/Build" -B "$d" -DCMAKE_BUILD_TYPE=Distribution -DDOUBLE_PRECISION=$dp -DTARGET_UNIT_TESTS=OFF -DTARGET_HELLO_WORLD=OFF -DTARGET_PERFORMANCE_TEST=OFF -DTARGET_SAMPLES=OFF -DTARGET_VIEWER=OFF -DINTERPROCEDURAL_OPTIMIZATION=OFF
      cmake --build "$d" -j"$J"
    fi
    defs=$(sed -n 's/^CXX_DEFINES = //p' "$d/CMakeFiles/Jolt.dir/flags.make")
    g++ -O3 -std=c++17 $defs -mavx2 -mbmi -mpopcnt -mlzcnt -mf16c -mfma -mfpmath=sse -ffp-contract=off -I"$V" "$here/src/jolt.cpp" "$B/build/driver.o" "$d/libJolt.a" -lpthread -o "$B/bin/jolt_$p"
  done
fi
if has rapier; then
  for v in f32 f64 ${PEERS_RAPIER_PAR:+f32,parallel f64,parallel}; do
    n=${v/,parallel/_par}; d=$B/target_rapier_$n; mkdir -p "$d/src"; cp -r "$here/rapier_capi/." "$d/src/"
    (cd "$d/src" && CARGO_TARGET_DIR=$d RUSTFLAGS="-C target-cpu=$ARCH" CARGO_PROFILE_RELEASE_LTO=thin cargo build --release --features "$v")
    $CXX -DRNAME="\"rapier-$n\"" "$here/src/rapier.cpp" "$B/build/driver.o" "$d/release/librapier_capi.a" -lpthread -ldl -lm -o "$B/bin/rapier_$n"
  done
fi
if has bullet; then  # Debian's build: -O2, baseline x86-64
  inc=$(pkg-config --cflags bullet)
  $CXX -DBT_USE_DOUBLE_PRECISION $inc "$here/src/bullet.cpp" "$B/build/driver.o" -lBulletDynamics-float64 -lBulletCollision-float64 -lLinearMath-float64 -o "$B/bin/bullet_f64_deb"
  $CXX $inc "$here/src/bullet.cpp" "$B/build/driver.o" -lBulletDynamics -lBulletCollision -lLinearMath -o "$B/bin/bullet_f32_deb"
fi
has ode && $CXX -DdIDEDOUBLE "$here/src/ode.cpp" "$B/build/driver.o" -lode -o "$B/bin/ode_f64_deb"
if has mujoco; then
  [ -d "$B/venv" ] || { python3 -m venv "$B/venv"; "$B/venv/bin/pip" install -q mujoco==4.0.0; }
  M=$("$B/venv/bin/python" -c 'import importlib.util as u; print(u.find_spec("mujoco").submodule_search_locations[0])')
  L=$(ls "$M"/libmujoco.so.*); $CXX -I"$M/include" "$here/src/mujoco.cpp" "$B/build/driver.o" "$L" -Wl,-rpath,"$M" -o "$B/bin/mujoco"
fi
if has physx; then  # the crate's own build compiles the bundled C++; then the C++ API is used directly
  d=$B/physx; mkdir -p "$d/src"; printf '[package]\nname="px"\nversion="0.0.0"\nedition="2021"\n[dependencies]\nphysx-sys="=0.11.5"\n' > "$d/Cargo.toml"; echo 'fn main(){}' > "$d/src/main.rs"
  (cd "$d" && CC=gcc CXX=g++ CARGO_TARGET_DIR="$B/target" CXXFLAGS="-march=$ARCH -O3" cargo build --release)
  L=$(find "$B/target/release/build" -name 'libphysx.a' | head -1); V=$(echo "$B"/vendor/physx-sys-*/physx/physx)
  $CXX -DNDEBUG -DPX_PHYSX_STATIC_LIB -DDISABLE_CUDA_PHYSX -I"$V/include" "$here/src/physx.cpp" "$B/build/driver.o" $(find "$(dirname "$L")" -name 'libphysx*.a') "$L" -lpthread -ldl -o "$B/bin/physx"
fi
ls "$B/bin"
