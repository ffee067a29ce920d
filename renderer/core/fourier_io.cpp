#include "renderer/core/fourier.h"
#include "renderer/core/image_codec.h"
#include "renderer/core/module_io.h"

namespace patina {

const FourierTransform& fourier_transform() {
    using Entry = const FourierTransform* (*)();
    static const FourierTransform* const transform =
        reinterpret_cast<Entry>(module_symbol(kImageModule, kFourierEntry))();
    return *transform;
}

}  // namespace patina
