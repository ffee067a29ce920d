// One ingredient instead of the picture. Light is shown as it is; stored numbers are shown as their bytes: a value x is
// written as the linear light whose sRGB code is x.

// Cells of an eighth of the unit square, hue across u, brightness along v; the dark corner of each cell is its lower
// left and twice as wide as high, so a mirrored or turned island shows.
vec3 uv_checker(vec2 uv) {
    vec2 cell = floor(fract(uv) * 8.0);
    vec2 inside = fract(uv * 8.0);
    float odd = mod(cell.x + cell.y, 2.0);
    vec3 hue = clamp(abs(fract(cell.x / 8.0 + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
    vec3 color = mix(vec3(0.75), hue, 0.45) * mix(0.45, 1.0, (cell.y + 1.0) / 8.0);
    color *= mix(0.55, 1.0, odd);
    if (inside.x < 0.4 && inside.y < 0.2) color *= 0.25;
    return color;
}

// Views of stored numbers, which need no light; the numbers are DebugView's.
vec3 stored_color(int view, Surface s, vec3 N, vec3 V, vec2 st) {
    if (view == 1) return s.albedo;
    if (view == 2) return decode_srgb(vec3(s.roughness));
    if (view == 3) return decode_srgb(vec3(s.metallic));
    if (view == 4) return decode_srgb(vec3(s.ao));
    if (view == 5) {
#ifdef HAS_NORMAL_MAP
        return decode_srgb(clamp(texture(normal_map, st).rgb, 0.0, 1.0));
#else
        return decode_srgb(vec3(0.5, 0.5, 1.0));
#endif
    }
    if (view == 6) return decode_srgb(clamp(N * 0.5 + 0.5, 0.0, 1.0));
    if (view == 7) {
        float size2 = dot(world_tangent.xyz, world_tangent.xyz);
        vec3 t = size2 > 1e-12 ? world_tangent.xyz * inversesqrt(size2) : vec3(0.0);
        return decode_srgb(clamp(t * 0.5 + 0.5, 0.0, 1.0));
    }
    if (view == 8) return decode_srgb(vec3(fract(map_uv), 0.0));
    return decode_srgb(uv_checker(map_uv) * (0.4 + 0.6 * clamp(dot(N, V), 0.0, 1.0)));
}

vec3 debug_color(Surface s, Geometry g, vec2 st) {
    int view = int(counts.y);
    if (view == 12) return s.emission;
    if (view < 10) return stored_color(view, s, g.N, g.V, st);
    Reflected light = reflected_light(s, g);
    return view == 10 ? light.diffuse : light.specular;
}
