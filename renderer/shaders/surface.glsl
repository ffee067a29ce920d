// A point of the mesh as it is rasterised: its maps and the normal that is shaded.

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

MapTexels read_maps(vec2 st) {
    MapTexels m = MapTexels(vec3(1.0), 0.0, 0.0, 0.0, 0.0, vec3(1.0));
#ifdef HAS_NORMAL_MAP
    m.spread = min(square(at_least(1.0 - texture(normal_map, st).a, 0.0) * normal_x.w), 1.0);   // as map_levels.h stores it
#endif
#ifdef HAS_ALBEDO_MAP
    m.albedo = texture(albedo_map, st).rgb;
#endif
#ifdef HAS_ROUGHNESS_MAP
    vec4 scalars = texture(roughness_map, st);
    m.roughness = dot(scalars, roughness);
#endif
#ifdef METALLIC_WITH_ROUGHNESS   // in the same picture
    m.metallic = dot(scalars, metallic);
#elif defined(HAS_METALLIC_MAP)
    m.metallic = dot(texture(metallic_map, st), metallic);
#endif
#ifdef AO_WITH_ROUGHNESS
    m.ao = dot(scalars, ao);
#elif defined(HAS_AO_MAP)
    m.ao = dot(texture(ao_map, st), ao);
#endif
#ifdef HAS_EMISSION_MAP
    m.emission = texture(emission_map, st).rgb;
#endif
    return m;
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

PixelNormals pixel_normals(vec3 N) {
    vec3 across = dFdx(N);
    vec3 up = dFdy(N);
    float largest2 = max(dot(across, across), dot(up, up));
    float scale = min(1.0, 0.5 * inversesqrt(max(largest2, 1e-20)));
    return PixelNormals(scale * across, scale * up);
}

Geometry read_geometry(vec2 st) {
    vec3 V = -normalize(camera_ray(gl_FragCoord.xy));
    vec3 N = shading_normal(V, st);
    PixelNormals around = pixel_normals(N);
    return Geometry(N, V, around, pixel_spread(around));
}
