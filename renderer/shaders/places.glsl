// Where in the picture a fragment lies that was laid beside others.
uniform usampler2D fragment_places;   // x, y and sample

vec2 stored_pixel() { return vec2(texelFetch(fragment_places, ivec2(gl_FragCoord.xy), 0).xy) + 0.5; }
