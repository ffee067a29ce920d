// A surface that was rasterised before (surfaces.frag.glsl): each texel is one fragment.

uniform sampler2D stored_normals;    // N; pixel_spread, but for sharp lobes how N changes over the pixel, across: x,
uniform sampler2D stored_turns;      // y and z, and up: x, y,
uniform sampler2D stored_scalars;    // and z; metallic and ao maps; spread of the normals that a normal map averages
uniform sampler2D stored_colors;     // albedo map; roughness map
uniform sampler2D stored_emissions;  // emission map

// pixel: where in the picture it lies.
Geometry stored_geometry(vec2 pixel) {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 normal = texelFetch(stored_normals, at, 0);
    vec3 V = -normalize(camera_ray(pixel));
#ifdef HAS_SHARP
    vec4 turn = texelFetch(stored_turns, at, 0);
    vec3 up = vec3(turn.zw, texelFetch(stored_scalars, at, 0).x);
    PixelNormals around = PixelNormals(vec3(normal.w, turn.xy), up);
    return Geometry(normal.xyz, V, around, pixel_spread(around));
#else
    return Geometry(normal.xyz, V, PixelNormals(vec3(0.0), vec3(0.0)), normal.w);
#endif
}

// Scalars were stored as their channel holds them; a row of the material has one entry, ±value, or none.
MapTexels stored_maps() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    MapTexels m = MapTexels(vec3(1.0), 0.0, 0.0, 0.0, 0.0, vec3(1.0));
#ifdef HAS_STORED_MAPS
    vec4 color = texelFetch(stored_colors, at, 0);
    vec4 scalars = texelFetch(stored_scalars, at, 0);
    m.albedo = color.rgb;
    m.roughness = color.a * dot(roughness, vec4(1.0));
    m.metallic = scalars.y * dot(metallic, vec4(1.0));
    m.ao = scalars.z * dot(ao, vec4(1.0));
    m.spread = scalars.w;
#endif
#ifdef HAS_EMISSION_MAP
    m.emission = texelFetch(stored_emissions, at, 0).rgb;
#endif
    return m;
}
