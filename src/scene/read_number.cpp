#include "scene/read_number.hpp"

namespace lanecast {

bool is_overflow(std::string_view number) {
    // Out of range means an exponent beyond +-300, so its sign decides, unless hundreds of digits do.
    long long magnitude = 0; // decimal exponent of the first digit that is not 0, plus one
    bool point = false;
    bool started = false;
    std::size_t i = 0;
    for (; i < number.size() && number[i] != 'e' && number[i] != 'E'; ++i) {
        if (number[i] == '.') point = true;
        if (number[i] < '0' || number[i] > '9') continue;
        started = started || number[i] != '0';
        if (started && !point) ++magnitude;
        if (!started && point) --magnitude;
    }
    if (i == number.size()) return magnitude > 0;
    const bool negative = i + 1 < number.size() && number[i + 1] == '-';
    long long exponent = 0;
    for (++i; i < number.size() && exponent < 1'000'000'000'000; ++i)
        if (number[i] >= '0' && number[i] <= '9') exponent = exponent * 10 + (number[i] - '0');
    return magnitude + (negative ? -exponent : exponent) > 0;
}

} // namespace lanecast
