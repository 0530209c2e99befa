// The public header alone, twice, in a second translation unit.
#include <lanecast/lanecast.hpp>
