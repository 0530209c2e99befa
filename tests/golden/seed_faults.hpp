#pragma once
// What the program behind the reference pictures does differently from issue section 3, as switches. The numbers are those of
// the list of its faults (docs/shading.md repeats those that show). All off: Whitted's model as Lanecast means it.

#include <array>

namespace lanecast::test {

struct SeedFaults {
    bool cylinder_caps = false; ///< a cylinder is missed where both crossings of its side lie beyond the caps
    bool normals_by_m = false;  ///< normals by the matrix, not its inverse transpose; of triangles and caps not renormalised
    bool plane_normal_length = false; ///< a plane's normal is used at the length the file gives it
    bool strict_inside = false;       ///< a point on a triangle's edge is outside
    bool single_precision = false;    ///< float throughout, with the textbook quadratic; off: double
    bool absolute_tmin = false;       ///< rays start at t = 0.001, in units of a direction of any length
    bool unnormalised_snell = false;  ///< Snell's law and Schlick's term take the camera ray's direction as it is, up to 1.3 long
    bool entry_at_exit = false;       ///< a box that holds the origin is pruned by where the ray leaves it
    bool sphere_box_corners = false;  ///< a sphere's box from two opposite corners of its cube
    bool cylinder_box_unscaled = false; ///< a cylinder's box ignores scales
    bool untransformed_box = false;     ///< a triangle's box also holds the vertices before their transformation
    bool light_grows = false;           ///< point and spot light times 1 + 0.001 d + 0.00001 d^2
    bool planes_never_shadow = false;   ///< directional light passes where the nearest blocker is a plane
    bool spot_axis = false;             ///< a spot's diffuse term is squared in `diffuse` and uses the cone's axis for N.L
    bool directional_power = false;     ///< (N.H)^shininess of a directional light without max(N.H, 0)
    bool unmasked_specular = false;     ///< highlights also where N.L <= 0
    bool clamped_light = false;         ///< diffuse + specular is clamped to [0, 1] before the light's colour
    bool clamped_bounce = false;        ///< the colour of every ray is clamped to [0, 1]
    bool unflipped_normal = false;      ///< local light by the outward normal, also on the inside
    bool incident_schlick = false; ///< Schlick's term by the incident cosine on both sides, and under total internal reflection
};

struct SeedFault {
    const char* name;
    const char* number; ///< in the list of faults
    bool SeedFaults::*on;
};

inline constexpr std::array<SeedFault, 20> seed_faults = {{
    {"cylinder_caps", "1", &SeedFaults::cylinder_caps},
    {"normals_by_m", "2", &SeedFaults::normals_by_m},
    {"plane_normal_length", "3", &SeedFaults::plane_normal_length},
    {"strict_inside", "4", &SeedFaults::strict_inside},
    {"single_precision", "5", &SeedFaults::single_precision},
    {"absolute_tmin", "6", &SeedFaults::absolute_tmin},
    {"unnormalised_snell", "8", &SeedFaults::unnormalised_snell},
    {"entry_at_exit", "13", &SeedFaults::entry_at_exit},
    {"sphere_box_corners", "14", &SeedFaults::sphere_box_corners},
    {"cylinder_box_unscaled", "15", &SeedFaults::cylinder_box_unscaled},
    {"untransformed_box", "16", &SeedFaults::untransformed_box},
    {"light_grows", "20", &SeedFaults::light_grows},
    {"planes_never_shadow", "21", &SeedFaults::planes_never_shadow},
    {"spot_axis", "23", &SeedFaults::spot_axis},
    {"directional_power", "24", &SeedFaults::directional_power},
    {"unmasked_specular", "25", &SeedFaults::unmasked_specular},
    {"clamped_light", "25", &SeedFaults::clamped_light},
    {"clamped_bounce", "25", &SeedFaults::clamped_bounce},
    {"unflipped_normal", "26", &SeedFaults::unflipped_normal},
    {"incident_schlick", "29", &SeedFaults::incident_schlick},
}};

[[nodiscard]] constexpr SeedFaults all_seed_faults() {
    SeedFaults faults;
    for (const SeedFault& fault : seed_faults) faults.*fault.on = true;
    return faults;
}

[[nodiscard]] constexpr SeedFaults with(SeedFaults faults, const SeedFault& fault, bool on) {
    faults.*fault.on = on;
    return faults;
}

} // namespace lanecast::test
