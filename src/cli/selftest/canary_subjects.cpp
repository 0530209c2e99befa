#include "cli/selftest/canary_subjects.hpp"

#include <cmath>

#include <immintrin.h>

#ifdef LANECAST_CANARY
namespace LANECAST_CANARY {
CANARY_SUBJECTS
#else
namespace flagged {
#endif

// g++ 12.2 -O2 returns in[0] and in[1] unrounded: its SLP vectoriser takes the pair of conversions for the identity.
struct Float3 {
    float x, y, z;
};
void round_to_float(const double in[3], double out[3]) {
    const Float3 rounded{static_cast<float>(in[0]), static_cast<float>(in[1]), static_cast<float>(in[2])};
    out[0] = static_cast<double>(rounded.x);
    out[1] = static_cast<double>(rounded.y);
    out[2] = static_cast<double>(rounded.z);
}

float multiply_add(float a, float b, float c) { return a * b + c; }

float multiply_add_packed(float a, float b, float c) {
    return _mm_cvtss_f32(_mm_add_ps(_mm_mul_ps(_mm_set1_ps(a), _mm_set1_ps(b)), _mm_set1_ps(c)));
}

float multiply_add_widest(float a, float b, float c) {
#if defined(__AVX512F__)
    return _mm512_cvtss_f32(_mm512_add_ps(_mm512_mul_ps(_mm512_set1_ps(a), _mm512_set1_ps(b)), _mm512_set1_ps(c)));
#elif defined(__AVX__)
    return _mm256_cvtss_f32(_mm256_add_ps(_mm256_mul_ps(_mm256_set1_ps(a), _mm256_set1_ps(b)), _mm256_set1_ps(c)));
#else
    return multiply_add_packed(a, b, c);
#endif
}

float smaller(float a, float b) { return a < b ? a : b; }
float larger(float a, float b) { return a > b ? a : b; }
float smaller_packed(float a, float b) { return _mm_cvtss_f32(_mm_min_ps(_mm_set1_ps(a), _mm_set1_ps(b))); }
float larger_packed(float a, float b) { return _mm_cvtss_f32(_mm_max_ps(_mm_set1_ps(a), _mm_set1_ps(b))); }

float multiply(float a, float b) { return a * b; }
float add(float a, float b) { return a + b; }

// Loops that the compiler vectorises; with reciprocal approximations if flags let it.
void divide(const float a[8], const float b[8], float out[8]) {
    for (int i = 0; i < 8; ++i) out[i] = a[i] / b[i];
}
void square_root(const float a[8], float out[8]) {
    for (int i = 0; i < 8; ++i) out[i] = std::sqrt(a[i]);
}

} // namespace
