// Nearer than everything where a pixel rests, so that nothing is drawn there.
uniform sampler2D reference_counts;
layout(location = 0) out float stored_fragment;

void main() {
    if (texelFetch(reference_counts, ivec2(gl_FragCoord.xy), 0).g > 0.5) discard;
    stored_fragment = 0.0;
    gl_FragDepth = 0.0;
}
