#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds carom and its rivals and runs them side by side, interleaved, in one go.
#   compare.sh [scene prefixes] [engines]     for example: compare.sh S1-free own,physx-pgs
# Everything is built under $PEERS_BUILD (default ${TMPDIR:-/tmp}/peers); what is built already is
# kept. The results go to $PEERS_OUT (default there too), the table to stdout.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
export PEERS_BUILD=${PEERS_BUILD:-${TMPDIR:-/tmp}/peers}
scenes=${1:-S1-free}
engines=${2:-own,physx-pgs,physx-tgs,box3d,jolt,rapier-f32,rapier-f64,bullet-f64-deb,ode-f64,mujoco}
declare -A binary=([own]=own [box3d]=box3d_f32_v3 [jolt]=jolt_f32 [rapier]=rapier_f32
  [bullet]=bullet_f64_deb [ode]=ode_f64_deb [mujoco]=mujoco [physx]=physx)
want=(own)  # always: it may have changed
for engine in box3d jolt rapier bullet ode mujoco physx; do
  [[ $engines == *$engine* && ! -x $PEERS_BUILD/bin/${binary[$engine]} ]] && want+=("$engine")
done
"$here/build.sh" "${want[@]}" >&2
out=${PEERS_OUT:-$PEERS_BUILD/results-$(date -u +%Y%m%dT%H%M%SZ).json}
"$here/run_peers.py" --bin "$PEERS_BUILD/bin" --json "$out" --scenes "$scenes" \
  --engines "$engines" --reps "${PEERS_REPS:-5}"
