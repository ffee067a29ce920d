// The material at one point: what the maps hold there, times the material's values.

struct MapTexels {
    vec3 albedo;
    float roughness;   // likewise metallic and ao: the chosen channel times its row, to which the bias is added
    float metallic;
    float ao;
    float spread;      // of the normals that the pixel averages, to be added to alpha²
    vec3 emission;
};

struct Surface {
    vec3 albedo;
    float roughness;
    float metallic;
    float ao;
    vec3 emission;
    float spread;
};

// Not NaN (every comparison with NaN is false), not below the floor.
float at_least(float x, float floor_value) { return x > floor_value ? x : floor_value; }
vec3 at_least(vec3 c, float floor_value) {
    return vec3(at_least(c.x, floor_value), at_least(c.y, floor_value), at_least(c.z, floor_value));
}
float unit_range(float x) { return min(at_least(x, 0.0), 1.0); }

Surface surface_of(MapTexels m) {
    Surface s;
    s.albedo = albedo.rgb;
    s.roughness = scalar_bias.x;
    s.metallic = scalar_bias.y;
    s.ao = scalar_bias.z;
    s.emission = vec3(0.0);
    s.spread = 0.0;
#ifdef HAS_NORMAL_MAP
    s.spread = m.spread;
#endif
#ifdef HAS_ALBEDO_MAP
    s.albedo *= m.albedo;
#endif
#ifdef HAS_ROUGHNESS_MAP
    s.roughness += m.roughness;
#endif
#ifdef HAS_METALLIC_MAP
    s.metallic += m.metallic;
#endif
#ifdef HAS_AO_MAP
    s.ao += m.ao;
#endif
#ifdef HAS_EMISSION
    s.emission = emission.rgb;
#ifdef HAS_EMISSION_MAP
    s.emission *= m.emission;
#endif
    s.emission = at_least(s.emission, 0.0);
#endif
    s.albedo = min(at_least(s.albedo, 0.0), vec3(1.0));
    s.roughness = unit_range(s.roughness);
    s.metallic = unit_range(s.metallic);
    s.ao = unit_range(s.ao);
    return s;
}

// How the normal changes from a pixel to its neighbours. At a silhouette, where it turns without end, those that it is
// measured against lie beside the surface.
struct PixelNormals {
    vec3 across;
    vec3 up;
};

// What they add to alpha² for a small light, whose half vectors stand still while the normal turns. A pixel's mean is a box one
// pixel wide, whose variance is 1/12 a side. Slopes of variance σ² along an axis have α² = 2σ² (Beckmann's α is GGX's in the
// middle), and the two axes of the tangent plane have half of the whole variance (|∂x N|² + |∂y N|²)/12 each.
float pixel_spread(PixelNormals n) { return (dot(n.across, n.across) + dot(n.up, n.up)) / 12.0; }

// Where the surface lies under the picture: what is shaded there beside the material's numbers.
struct Geometry {
    vec3 N;                 // as shaded
    vec3 V;
    PixelNormals around;    // of N
    float spread;           // pixel_spread of that
};
