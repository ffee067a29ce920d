// A drawn picture, sample by sample: as it was rasterised, or put together from fragments shaded side by side.

#if defined(SAMPLES) && !defined(HAS_STORED)
uniform sampler2DMS picture;
#else
uniform sampler2D picture;
#endif

#ifdef HAS_STORED
uniform usampler2D fragment_of_pixel;     // its number; with the highest bit set: of the pixel's row in the next
uniform usampler2D fragments_of_samples;  // a number for each sample

vec4 picture_fragment(uint number) { return texelFetch(picture, ivec2(number % STORED_WIDTH, number / STORED_WIDTH), 0); }
vec4 picture_sample(ivec2 at, int i) {
    uint number = texelFetch(fragment_of_pixel, at, 0).r;
    if ((number & 0x80000000u) == 0u) return picture_fragment(number);
    number &= 0x7fffffffu;
    return picture_fragment(texelFetch(fragments_of_samples, ivec2(number % STORED_WIDTH, number / STORED_WIDTH), 0)[i]);
}
bool picture_is_one(ivec2 at) { return (texelFetch(fragment_of_pixel, at, 0).r & 0x80000000u) == 0u; }
#else
vec4 picture_sample(ivec2 at, int i) { return texelFetch(picture, at, i); }
bool picture_is_one(ivec2 at) { return false; }
#endif
