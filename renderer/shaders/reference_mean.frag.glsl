// The mean of all that was gathered.
uniform sampler2D picture;
uniform vec2 reference_weight;   // 1/what the slices weighed together; the largest number the target holds

out vec4 picture_color;

void main() {
    vec4 mean = texelFetch(picture, ivec2(gl_FragCoord.xy), 0) * reference_weight.x;
    picture_color = vec4(min(mean.rgb, vec3(reference_weight.y)), mean.a);
}
