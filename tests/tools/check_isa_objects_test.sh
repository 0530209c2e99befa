#!/bin/bash
# tools/check_isa_objects.sh must accept a good object and name what is wrong with each bad one.
#   check_isa_objects_test.sh <source dir> <C++ compiler>
set -euo pipefail
check=$(realpath "$1")/tools/check_isa_objects.sh
compiler=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
failures=0

# compile <object> <flags...> with the source on stdin
compile() {
    local object=$1
    shift
    "$compiler" -std=c++20 -O2 -c -x c++ - -o "$object" "$@"
}
# expect <words of the finding, or nothing where all is well> <manifest line>...
expect() {
    local words=$1 output status=0
    shift
    printf '%s\n' "$@" >manifest
    output=$("$check" manifest) || status=$?
    if [ -z "$words" ]; then
        [ $status -eq 0 ] && [ -z "$output" ] && return
    else
        [ $status -eq 1 ] && grep -q -F -- "$words" <<<"$output" && return
    fi
    printf 'expected "%s", got status %s and:\n%s\n' "$words" "$status" "$output"
    failures=$((failures + 1))
}

compile good.o -mavx2 -mfma -ffp-contract=off <<<'namespace lanecast::inline avx2 {
    template <class T> __attribute__((noinline)) T twice(T x) { return x + x; }
    extern constinit const int kernels = 1;
    inline constexpr float table[4] = {1, 2, 3, 4};
    const float* f(int i) { return table + i; }
    float f(float a, float b, float c) { return twice(a * b + c); } }'
expect "" "avx2 good.o"
expect "forbidden instructions" "scalar good.o"
expect "forbidden instructions" "sse42 good.o"
expect "forbidden instructions" "baseline good.o"
expect "symbol outside lanecast::avx512" "avx512 good.o"

compile fused.o -mavx2 -mfma -ffp-contract=fast <<<'namespace lanecast::inline avx2 { float f(float a, float b, float c) { return a * b + c; } }'
expect "forbidden instructions" "avx2 fused.o"
expect "symbol outside lanecast::avx2_fast" "avx2_fast fused.o"
compile fused_fast.o -mavx2 -mfma -ffp-contract=fast <<<'namespace lanecast::inline avx2_fast { float f(float a, float b, float c) { return a * b + c; } }'
expect "" "avx2_fast fused_fast.o"
compile fused_precise.o -mavx2 -mfma -ffp-contract=fast <<<'namespace lanecast::inline avx2_precise { float f(float a, float b, float c) { return a * b + c; } }'
expect "forbidden instructions" "avx2_precise fused_precise.o"
compile fused512.o -mavx512f -mfma -ffp-contract=fast <<<'namespace lanecast::inline avx512 { float f(float a, float b, float c) { return a * b + c; } }'
expect "forbidden instructions" "avx512 fused512.o"
compile wide.o -mavx512f -mavx512vl -O3 -mprefer-vector-width=512 <<<'namespace lanecast::inline avx2 {
    void f(float* a) { for (int i = 0; i < 64; ++i) a[i] *= 2; } }'
expect "forbidden instructions" "avx2 wide.o"
compile wide_fast.o -mavx512f -mavx512vl -O3 -mprefer-vector-width=512 <<<'namespace lanecast::inline avx2_fast {
    void f(float* a) { for (int i = 0; i < 64; ++i) a[i] *= 2; } }'
expect "forbidden instructions" "avx2_fast wide_fast.o"
compile wide_precise.o -mavx512f -mavx512vl -O3 -mprefer-vector-width=512 <<<'namespace lanecast::inline avx2_precise {
    void f(double* a) { for (int i = 0; i < 64; ++i) a[i] *= 2; } }'
expect "forbidden instructions" "avx2_precise wide_precise.o"
compile narrow_precise.o -mavx2 -O3 <<<'namespace lanecast::inline sse42_precise { void f(double* a) { for (int i = 0; i < 64; ++i) a[i] *= 2; } }'
expect "forbidden instructions" "sse42_precise narrow_precise.o"
compile sse4.o -msse4.2 <<<'namespace lanecast::inline scalar { int f(unsigned a) { return __builtin_popcount(a); } }'
expect "forbidden instructions" "scalar sse4.o"
compile bmi.o -mbmi2 <<<'namespace lanecast::inline sse42 { unsigned f(unsigned a, unsigned b) { return a << b; } }'
expect "forbidden instructions" "sse42 bmi.o"

# A template outside the namespace: weak, and the same name in every ISA and in the baseline.
shared='template <class T> __attribute__((noinline)) T shared(T x) { return x * x; }'
compile shared_avx2.o -mavx2 <<<"$shared namespace lanecast::inline avx2 { float f(float a) { return shared(a); } }"
compile shared_sse42.o -msse4.2 <<<"$shared namespace lanecast::inline sse42 { float f(float a) { return shared(a); } }"
compile shared_baseline.o <<<"$shared float f(float a) { return shared(a); }"
expect "symbol outside lanecast::avx2: float shared<float>(float)" "avx2 shared_avx2.o"
expect "shared by avx2 sse42: float shared<float>(float)" "avx2 shared_avx2.o" "sse42 shared_sse42.o"
expect "shared by avx2 baseline: float shared<float>(float)" "avx2 shared_avx2.o" "baseline shared_baseline.o"
# A library's template, the same in two precisions of one ISA and in another ISA.
library='namespace xsimd { template <class T> __attribute__((noinline)) T shared(T x) { return x * x; } }'
compile library_avx2.o -mavx2 <<<"$library namespace lanecast::inline avx2 { float f(float a) { return xsimd::shared(a); } }"
compile library_fast.o -mavx2 <<<"$library namespace lanecast::inline avx2_fast { float f(float a) { return xsimd::shared(a); } }"
compile library_sse42.o -msse4.2 <<<"$library namespace lanecast::inline sse42 { float f(float a) { return xsimd::shared(a); } }"
compile library_precise.o -mavx2 <<<"$library namespace lanecast::inline avx2_precise { float f(float a) { return xsimd::shared(a); } }"
expect "" "avx2 library_avx2.o" "avx2_fast library_fast.o" "avx2_precise library_precise.o"
expect "shared by avx2 sse42: float xsimd::shared<float>(float)" "avx2_precise library_precise.o" "sse42 library_sse42.o"
expect "shared by avx2 sse42: float xsimd::shared<float>(float)" "avx2 library_avx2.o" "avx2_fast library_fast.o" "sse42 library_sse42.o"
compile global.o <<<'void global() {}'
expect "symbol outside lanecast::avx2: global()" "avx2 global.o"

compile init.o -mavx2 <<<'namespace lanecast::inline avx2 { float seed(); float start = seed(); }'
expect "section .init_array" "avx2 init.o"
compile guard.o -mavx2 <<<'namespace lanecast::inline avx2 { float seed(); float f() { static float s = seed(); return s; } }'
expect "__cxa_guard" "avx2 guard.o"
compile lto.o -mavx2 -flto <<<'namespace lanecast::inline avx2 { float f(float a) { return a; } }'
case $("$compiler" --version) in *clang*) ;; *) expect "compiled with LTO" "avx2 lto.o" ;; esac

[ $failures -eq 0 ]
