#!/bin/bash
# Installs the build into a temporary prefix, builds the example of the documentation and a small project with
# find_package(lanecast) against it and runs both.
#   install_test.sh <source dir> <build dir> <cmake> <C++ compiler>
set -euo pipefail
source=$1 build=$2 cmake=$3 compiler=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$cmake" --install "$build" --prefix "$work/prefix" >"$work/log" || { cat "$work/log"; exit 1; }
# Only the prefix must be needed: nothing in what was installed may name the source or the build directory, or another library.
if grep -r -l -F -e "$source/" -e "$build/" "$work/prefix" --include='*.cmake'; then
    echo "the installed package names the source or build directory"
    exit 1
fi
if grep -r -i -E 'glm|OpenEXR|PNG|embree|nlohmann' "$work/prefix" --include='*.cmake' --include='*.hpp'; then
    echo "the installed package names a library its users do not need"
    exit 1
fi
headers=$(cd "$work/prefix/include" && find . -type f)
if [ "$headers" != ./lanecast/lanecast.hpp ]; then
    echo "installed headers: $headers"
    exit 1
fi
cp -r "$source/tests/install/consumer" "$work/source"
cp "$source/docs/library_example.cpp" "$work/source/example.cpp"
"$cmake" -S "$work/source" -B "$work/consumer" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_FLAGS='-Wall -Wextra -Werror' \
    -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Release >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
"$cmake" --build "$work/consumer" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
"$work/consumer/consumer" "$work/source/scene.json"
"$work/consumer/example" >"$work/picture"
if [ "$(grep -c '#' "$work/picture")" -lt 5 ] || ! grep -q '\.#*o' "$work/picture" || [ "$(wc -l <"$work/picture")" -ne 24 ]; then
    cat "$work/picture"
    exit 1
fi
if [ -e "$build/lanecast" ]; then "$work/prefix/bin/lanecast" --version; fi
