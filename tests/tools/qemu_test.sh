#!/bin/bash
# Runs the program on an emulated Nehalem, which has SSE4.2 and nothing newer, so that no illegal instruction hides.
#   qemu_test.sh <qemu-x86_64> <source dir> <build dir>
set -euo pipefail
source=$2 build=$3
nehalem=("$1" -cpu Nehalem)
if ! "${nehalem[@]}" /bin/true 2>/dev/null; then
    echo "skipped: $1 cannot run programs here"
    exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The emulator must catch what this test is for.
if [ -x "$build/tests/test_canaries_avx2" ] && "${nehalem[@]}" "$build/tests/test_canaries_avx2" >/dev/null 2>&1; then
    echo "the emulated CPU runs AVX2 code"
    exit 1
fi
"${nehalem[@]}" "$build/tests/test_dispatch"
"${nehalem[@]}" "$build/tests/test_canaries_scalar"
if [ -x "$build/tests/test_canaries_sse42" ]; then "${nehalem[@]}" "$build/tests/test_canaries_sse42"; fi

[ -x "$build/lanecast" ] || exit 0
"${nehalem[@]}" "$build/lanecast" --version
scene=$source/scenes/showcase.json
[ -f "$scene" ] || exit 0
render() { "${nehalem[@]}" "$build/lanecast" render "$scene" --size 32x32 --quiet --no-volatile-metadata "$@"; }
render --isa scalar -o "$work/scalar"
if [ -x "$build/tests/test_canaries_sse42" ]; then
    render --isa sse4.2 -o "$work/sse42"
    cmp "$work/scalar.exr" "$work/sse42.exr"
    cmp "$work/scalar.png" "$work/sse42.png"
fi
status=0
render --isa avx2 -o "$work/avx2" 2>"$work/error" || status=$?
if [ $status -ne 7 ] || [ -e "$work/avx2.exr" ] || ! grep -q avx2 "$work/error"; then
    echo "--isa avx2 on a Nehalem: exit code $status, expected 7 and a line that names avx2"
    exit 1
fi
