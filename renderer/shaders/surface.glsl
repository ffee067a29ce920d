// The material at one point: maps, values and the normal that is shaded.

#ifdef HAS_ALBEDO_MAP
uniform sampler2D albedo_map;
#endif
#ifdef HAS_ROUGHNESS_MAP
uniform sampler2D roughness_map;
#endif
#ifdef HAS_METALLIC_MAP
uniform sampler2D metallic_map;
#endif
#ifdef HAS_AO_MAP
uniform sampler2D ao_map;
#endif
#ifdef HAS_NORMAL_MAP
uniform sampler2D normal_map;
#endif
#ifdef HAS_EMISSION_MAP
uniform sampler2D emission_map;
#endif

in vec3 world_position;
in vec3 world_normal;
in vec4 world_tangent;
in vec2 mesh_uv;
in vec2 map_uv;

struct Surface {
    vec3 albedo;
    float roughness;
    float metallic;
    float ao;
    vec3 emission;
    float spread;   // of the normals that the pixel averages, to be added to alpha²
};

// Not NaN (every comparison with NaN is false), not below the floor.
float at_least(float x, float floor_value) { return x > floor_value ? x : floor_value; }
vec3 at_least(vec3 c, float floor_value) {
    return vec3(at_least(c.x, floor_value), at_least(c.y, floor_value), at_least(c.z, floor_value));
}
float unit_range(float x) { return min(at_least(x, 0.0), 1.0); }

Surface read_surface(vec2 st) {
    Surface s;
    s.albedo = albedo.rgb;
    s.roughness = scalar_bias.x;
    s.metallic = scalar_bias.y;
    s.ao = scalar_bias.z;
    s.emission = vec3(0.0);
    s.spread = 0.0;
#ifdef HAS_NORMAL_MAP
    s.spread = min(square(at_least(1.0 - texture(normal_map, st).a, 0.0) * normal_x.w), 1.0);   // as map_levels.h stores it
#endif
#ifdef HAS_ALBEDO_MAP
    s.albedo *= texture(albedo_map, st).rgb;
#endif
#ifdef HAS_ROUGHNESS_MAP
    s.roughness += dot(texture(roughness_map, st), roughness);
#endif
#ifdef HAS_METALLIC_MAP
    s.metallic += dot(texture(metallic_map, st), metallic);
#endif
#ifdef HAS_AO_MAP
    s.ao += dot(texture(ao_map, st), ao);
#endif
#ifdef HAS_EMISSION
    s.emission = emission.rgb;
#ifdef HAS_EMISSION_MAP
    s.emission *= texture(emission_map, st).rgb;
#endif
    s.emission = at_least(s.emission, 0.0);
#endif
    s.albedo = min(at_least(s.albedo, 0.0), vec3(1.0));
    s.roughness = unit_range(s.roughness);
    s.metallic = unit_range(s.metallic);
    s.ao = unit_range(s.ao);
    return s;
}

#ifdef HAS_NORMAL_MAP
// Tangent and bitangent for an unnormalised interpolated normal n. As MikkTSpace's bakers do, neither is normalised nor
// made orthogonal here. Meshes without tangents have zero ones and get a frame from the uv gradients (Mikkelsen 2010).
mat2x3 tangent_frame(vec3 n) {
    vec3 t = world_tangent.xyz;
    vec3 b = (world_tangent.w < 0.0 ? -1.0 : 1.0) * cross(n, t);
    if (dot(b, b) > 1e-6) return mat2x3(t, b);
    vec3 dpdx = dFdx(world_position);
    vec3 dpdy = dFdy(world_position);
    vec2 dudx = dFdx(mesh_uv);
    vec2 dudy = dFdy(mesh_uv);
    vec3 across_y = cross(dpdy, n);
    vec3 across_x = cross(n, dpdx);
    t = across_y * dudx.x + across_x * dudy.x;
    b = across_y * dudx.y + across_x * dudy.y;
    float size2 = max(dot(t, t), dot(b, b));
    if (size2 > 1e-30) return mat2x3(t * inversesqrt(size2), b * inversesqrt(size2));
    vec3 axis = abs(n.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    t = normalize(cross(axis, n));
    return mat2x3(t, cross(n, t));
}
#endif

// The normal as shaded: interpolated, mapped, turned to the side that is seen (triangles are wound to agree with their
// normals), and where it still faces away bent until N·V = 1e-4 (a mirrored normal would reflect light from inside).
vec3 shading_normal(vec3 V, vec2 st) {
    float side = gl_FrontFacing ? 1.0 : -1.0;
    vec3 n = dot(world_normal, world_normal) > 1e-12 ? world_normal : side * V;
#ifdef HAS_NORMAL_MAP
    mat2x3 frame = tangent_frame(n);
    vec3 stored = texture(normal_map, st).xyz * 2.0 - 1.0;
    vec3 mapped = frame * vec2(dot(normal_x.xy, stored.xy), dot(normal_y.xy, stored.xy)) + stored.z * n;
    if (dot(mapped, mapped) > 1e-12) n = mapped;
#endif
    n = normalize(n) * side;
    float NoV = dot(n, V);
    if (NoV < 1e-4) n = normalize(n + (1e-4 - NoV) * V);
    return n;
}

// How the normal changes from a pixel to its neighbours. At a silhouette, where it turns without end, those that it is
// measured against lie beside the surface.
struct PixelNormals {
    vec3 across;
    vec3 up;
};
PixelNormals pixel_normals(vec3 N) {
    vec3 across = dFdx(N);
    vec3 up = dFdy(N);
    float largest2 = max(dot(across, across), dot(up, up));
    float scale = min(1.0, 0.5 * inversesqrt(max(largest2, 1e-20)));
    return PixelNormals(scale * across, scale * up);
}

// What they add to alpha² for a small light, whose half vectors stand still while the normal turns. A pixel's mean is a box one
// pixel wide, whose variance is 1/12 a side. Slopes of variance σ² along an axis have α² = 2σ² (Beckmann's α is GGX's in the
// middle), and the two axes of the tangent plane have half of the whole variance (|∂x N|² + |∂y N|²)/12 each.
float pixel_spread(PixelNormals n) { return (dot(n.across, n.across) + dot(n.up, n.up)) / 12.0; }
