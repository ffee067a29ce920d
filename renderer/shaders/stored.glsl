// A surface that was rasterised before (surfaces.frag.glsl): each texel is one fragment.

uniform sampler2D stored_normals;    // N; how it changes over the pixel: across, up,
uniform sampler2D stored_views;      // V; in the fourth of each
uniform sampler2D stored_turns;      // and here
uniform sampler2D stored_colors;     // albedo map; roughness map
uniform sampler2D stored_scalars;    // metallic and ao maps; spread of the normals that a normal map averages
uniform sampler2D stored_emissions;  // emission map

Geometry stored_geometry() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 normal = texelFetch(stored_normals, at, 0);
    vec4 view = texelFetch(stored_views, at, 0);
    vec4 turn = texelFetch(stored_turns, at, 0);
    return Geometry(normal.xyz, view.xyz, PixelNormals(vec3(normal.w, view.w, turn.x), turn.yzw));
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
    m.metallic = scalars.x * dot(metallic, vec4(1.0));
    m.ao = scalars.y * dot(ao, vec4(1.0));
    m.spread = scalars.z;
#endif
#ifdef HAS_EMISSION_MAP
    m.emission = texelFetch(stored_emissions, at, 0).rgb;
#endif
    return m;
}
