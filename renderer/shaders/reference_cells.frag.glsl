// How much a pixel reflects of the light of each of the panorama's cells, roughly: what it draws from them by. Once a picture.
#include "software.glsl"
#include "reference.glsl"

layout(location = 0) out uvec4 first_cells;   // four cells a word, the first in the lowest byte
layout(location = 1) out uvec4 last_cells;

const float kEvenShare = 0.003;   // a hundredth of what white reflects evenly: whatever the direction, no light is left out

// Reflected of a cell's light: a lobe as much wider as the cell is, from the cell's middle.
// With S = V + L: VoH = |S|/2, and D(H) = w |S|⁴/(π (S.x² + S.y² + w S.z²)²), w = alpha² + (width/|S|)². Its wide tails
// keep the weights from being far off where the cell's middle says little. Vis is taken as ½/mix(2 NoL NoV, NoL + NoV, alpha).
float reflected_of(Sampled p, mat3 frame, int i) {
    vec4 cell = cell_rows[2 * i];
    float width = cell_rows[2 * i + 1].x;
    vec3 middle = cell.xyz * frame;
    vec3 S = p.V + vec3(middle.xy, max(middle.z, 1e-3));
    float size2 = dot(S, S);
    float wide = p.alpha2 + cell.w / max(size2, 0.2);
    float spread = dot(S.xy, S.xy) + wide * S.z * S.z;
    float NoL = max(middle.z, 0.0) + 0.3 * width;
    float shadowed = mix(2.0 * NoL * p.V.z, NoL + p.V.z, sqrt(p.alpha2));
    float f0 = mean_channel(p.F0);
    float F = f0 + (1.0 - f0) * pow5(max(1.0 - 0.5 * sqrt(size2), 0.0));
    float single = 0.5 * F * wide * size2 * size2 / (spread * spread * shadowed);
    return (middle.z < -1.5 * width ? 0.0 : (single + mean_channel(p.body)) * NoL) + kEvenShare;
}

uint byte_of(Sampled p, mat3 frame, int i) {
    float root = sqrt(sqrt(min(reflected_of(p, frame, i) / kMostReflected, 1.0)));
    return uint(clamp(ceil(255.0 * root), 1.0, 255.0));
}

uint word_of(Sampled p, mat3 frame, int i) {
    return byte_of(p, frame, 4 * i) | byte_of(p, frame, 4 * i + 1) << 8u | byte_of(p, frame, 4 * i + 2) << 16u |
           byte_of(p, frame, 4 * i + 3) << 24u;
}

void main() {
    spare_whole_tiles();
    first_cells = last_cells = uvec4(0x01010101u);
    if (texelFetch(stored_fragments, ivec2(gl_FragCoord.xy), 0).r <= 0.0) return;
    Sampled p;
    mat3 frame;
    stored_surface(p, frame);
    first_cells = uvec4(word_of(p, frame, 0), word_of(p, frame, 1), word_of(p, frame, 2), word_of(p, frame, 3));
    last_cells = uvec4(word_of(p, frame, 4), word_of(p, frame, 5), word_of(p, frame, 6), word_of(p, frame, 7));
}
