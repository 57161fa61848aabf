#!/bin/sh
# Makes .venv in the checkout with carom and the extras named in $1, for example "ros,mesh".
# What only the system can give is installed where this user may, else named with the exact line.
set -eu
cd "$(dirname "$0")/.."
extras=$1

missing=""
lack() { missing="$missing $1"; }
command -v c++ >/dev/null || lack g++
if command -v python3 >/dev/null; then
  python3 -c 'import ensurepip, venv' 2>/dev/null || lack python3-venv
  python3 -c 'import os, sys, sysconfig
sys.exit(not os.path.exists(sysconfig.get_path("include") + "/Python.h"))' || lack python3-dev
else
  lack python3-venv
  lack python3-dev
fi
case ",$extras," in *,test,*)
  echo '#include <gtest/gtest.h>' | c++ -std=c++20 -E -x c++ - >/dev/null 2>&1 || lack libgtest-dev
  command -v valgrind >/dev/null || lack valgrind
esac
if [ -n "$missing" ]; then
  as=""
  [ "$(id -u)" = 0 ] || as="sudo -n"
  echo "carom: installing from the system's packages:$missing" >&2
  # shellcheck disable=SC2086  # word splitting is meant
  if ! { $as true && $as apt-get -qq update && $as apt-get -qq install -y $missing; } >&2; then
    echo "carom: could not install them. Please run, then repeat the command:" >&2
    echo "    sudo apt install$missing" >&2
    exit 3
  fi
fi

# The build tools come from PyPI into the venv itself: their paths stay, so a second run builds only
# what changed. (setuptools and wheel: a dependency of rclpy comes as source.)
if [ ! -x .venv/bin/pip ]; then
  python3 -m venv .venv
fi
echo "carom: preparing .venv (first time: three to six minutes)" >&2
.venv/bin/pip install -q --disable-pip-version-check \
  "scikit-build-core>=0.10" "pybind11>=2.13" "cmeel-eigen>=3.4" "cmake>=3.25" "ninja>=1.11" setuptools wheel
# With tests one tree serves the module and them: the library is compiled once.
tree=""
case ",$extras," in *,test,*)
  tree="-Cbuild-dir=build/release -Cbuild.targets=carom_core"
  for option in BUILD_TESTS BUILD_EXAMPLES WARNINGS_AS_ERRORS; do
    tree="$tree -Ccmake.define.CAROM_$option=ON"
  done
esac
# shellcheck disable=SC2086  # word splitting is meant
PATH="$PWD/.venv/bin:$PATH" .venv/bin/pip install -q --disable-pip-version-check \
  --no-build-isolation $tree ".[$extras]"
