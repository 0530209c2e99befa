#!/bin/bash
# Installs the build into a temporary prefix, builds a small project with find_package(lanecast) against it and runs both.
#   install_test.sh <source dir> <build dir> <cmake> <C++ compiler>
set -euo pipefail
source=$1 build=$2 cmake=$3 compiler=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$cmake" --install "$build" --prefix "$work/prefix" >"$work/log" || { cat "$work/log"; exit 1; }
# Only the prefix must be needed: nothing in what was installed may name the source or the build directory.
if grep -r -l -F -e "$source/" -e "$build/" "$work/prefix" --include='*.cmake'; then
    echo "the installed package names the source or build directory"
    exit 1
fi
# The consumer, and every installed header in a translation unit, twice.
cp -r "$source/tests/install/consumer" "$work/source"
(cd "$work/prefix/include/lanecast" && find . -name '*.hpp' | sed 's|^\./\(.*\)|#include <\1>|') >"$work/headers"
cat "$work/headers" "$work/headers" >"$work/source/headers.cpp"
"$cmake" -S "$work/source" -B "$work/consumer" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" \
    -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Release >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
"$cmake" --build "$work/consumer" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
"$work/consumer/consumer"
if [ -e "$build/lanecast" ]; then "$work/prefix/bin/lanecast" --version; fi
