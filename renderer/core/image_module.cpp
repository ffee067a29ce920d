// The module patina_images: JPEG, TIFF, TGA, BMP and PNG with camera data, and the Fourier transform, through
// OpenImageIO, which brings some 250 shared libraries along and therefore stays out of the program until a
// picture needs it.
#include "renderer/core/file_io.h"
#include "renderer/core/fourier.h"
#include "renderer/core/image_channels.h"
#include "renderer/core/image_codec.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <cstring>
#include <memory>
#include <stdexcept>

namespace patina {
namespace {

using Bytes = std::span<const std::byte>;

/// Once a process: decoding stays on the calling thread; no plug-ins come in from elsewhere.
void configure_library() {
    static const bool done = [] {
        OIIO::attribute("threads", 1);
        OIIO::attribute("plugin_searchpath", "");
        return true;
    }();
    static_cast<void>(done);
}

PixelType pixel_type_of(const OIIO::TypeDesc& format) {
    switch (format.basetype) {
        case OIIO::TypeDesc::UINT8:
            return PixelType::U8;
        case OIIO::TypeDesc::UINT16:
            return PixelType::U16;
        default:
            return PixelType::F32;
    }
}

OIIO::TypeDesc type_desc_of(PixelType type) {
    switch (type) {
        case PixelType::U8:
            return OIIO::TypeDesc::UINT8;
        case PixelType::U16:
            return OIIO::TypeDesc::UINT16;
        case PixelType::F32:
            break;
    }
    return OIIO::TypeDesc::FLOAT;
}

/// An open decoder, over bytes in memory or over the file itself. Of a TIFF's pages and a JPEG's previews the
/// first is the picture.
struct Decoder {
    std::unique_ptr<OIIO::Filesystem::IOMemReader> memory;
    std::unique_ptr<OIIO::ImageInput> input;
    ImageFormat format = ImageFormat::Unknown;
    ChannelChoice choice;
    OIIO::ImageSpec spec;
};

void check_spec(const OIIO::ImageSpec& spec) {
    if (const std::string problem = size_problem(spec.width, spec.height); !problem.empty())
        throw std::runtime_error(problem);
    if (spec.nchannels < 1) throw std::runtime_error("has no channels; export it again");
    if (spec.deep) throw std::runtime_error("holds deep data; flatten it");
    if (spec.depth > 1) throw std::runtime_error("is a volume; export one slice of it");
}

Decoder open_decoder(const ImageSource& source) {
    configure_library();
    Decoder decoder{.format = source.format};
    const std::string id(image_format_id(source.format));
    decoder.input = OIIO::ImageInput::create(id);
    if (!decoder.input)
        throw std::runtime_error("cannot be decoded by the installed OpenImageIO (" +
                                 one_line(OIIO::geterror()) + "); convert it to PNG");
    OIIO::ImageSpec config;
    config["oiio:UnassociatedAlpha"] = 1;
    const bool in_memory = !source.bytes.empty();
    if (in_memory) {
        decoder.memory =
            std::make_unique<OIIO::Filesystem::IOMemReader>(source.bytes.data(), source.bytes.size());
        OIIO::Filesystem::IOProxy* proxy = decoder.memory.get();
        config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    }
    OIIO::ImageSpec first;
    if (!decoder.input->open(in_memory ? "memory." + id : path_text(source.file), first, config))
        throw std::runtime_error(damaged(decoder.input->geterror()));
    decoder.spec = decoder.input->spec(0);
    check_spec(decoder.spec);
    decoder.choice = choose_channels(decoder.spec.channelnames);
    return decoder;
}

/// EXIF orientation that is still to be applied. A TGA's reader has applied it.
int orientation_of(const Decoder& decoder) {
    return decoder.format == ImageFormat::Targa ? 1 : decoder.spec.get_int_attribute("Orientation", 1);
}

DecodedHeader header(const ImageSource& source) {
    const Decoder decoder = open_decoder(source);
    DecodedHeader result{.info = {.width = decoder.spec.width,
                                  .height = decoder.spec.height,
                                  .channels = static_cast<int>(decoder.choice.channels.size()),
                                  .type = pixel_type_of(decoder.spec.format),
                                  .format = std::string(image_format_id(decoder.format))}};
    if (orientation_of(decoder) >= 5) std::swap(result.info.width, result.info.height);
    for (const OIIO::ParamValue& row : decoder.spec.extra_attribs)
        if (!row.name().string().starts_with("oiio:"))
            result.metadata.emplace_back(row.name().string(), row.get_string());
    return result;
}

/// The chosen channels. Neighbouring ones are read at once, straight to where they stay.
Image read_channels(const Decoder& decoder) {
    const OIIO::ImageSpec& spec = decoder.spec;
    const std::vector<int>& wanted = decoder.choice.channels;
    const PixelType type = pixel_type_of(spec.format);
    Image image = make_image(spec.width, spec.height, static_cast<int>(wanted.size()), type);
    const auto pixel_size = static_cast<OIIO::stride_t>(wanted.size() * bytes_per_channel(type));
    for (std::size_t first = 0; first < wanted.size();) {
        std::size_t end = first + 1;
        while (end < wanted.size() && wanted[end] == wanted[end - 1] + 1) ++end;
        if (!decoder.input->read_image(0, 0, wanted[first], wanted[end - 1] + 1, type_desc_of(type),
                                       image.bytes.data() + first * bytes_per_channel(type), pixel_size,
                                       pixel_size * spec.width))
            throw std::runtime_error(damaged(decoder.input->geterror()));
        first = end;
    }
    return image;
}

DecodedImage decode(const ImageSource& source) {
    const Decoder decoder = open_decoder(source);
    const OIIO::ImageSpec& spec = decoder.spec;
    if (!can_hold(source.format, source.bytes.size(), static_cast<std::uint64_t>(spec.width) * spec.height))
        throw std::runtime_error("promises more pixels than it holds; copy or export it again");
    DecodedImage decoded{.loaded = {.image = read_channels(decoder)}, .orientation = orientation_of(decoder)};
    if (std::string note = left_out_note(spec.channelnames, decoder.choice); !note.empty())
        decoded.loaded.notes.push_back(std::move(note));
    return decoded;
}

constexpr ImageCodec kCodec{.header = header, .decode = decode};

// ---- the Fourier transform ----

OIIO::ImageBuf buffer_of(const Image& image) {
    const OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT);
    OIIO::ImageBuf buffer(spec, OIIO::InitializePixels::No);
    std::memcpy(buffer.localpixels(), image.bytes.data(), image.bytes.size());
    return buffer;
}

Image image_of(const OIIO::ImageBuf& buffer) {
    if (buffer.has_error()) throw std::runtime_error(one_line(buffer.geterror()));
    const OIIO::ImageSpec& spec = buffer.spec();
    Image image = make_image(spec.width, spec.height, spec.nchannels, PixelType::F32);
    buffer.get_pixels(OIIO::ROI::All(), OIIO::TypeDesc::FLOAT, image.bytes.data());
    return image;
}

Image forward(const Image& picture) {
    configure_library();
    return image_of(OIIO::ImageBufAlgo::fft(buffer_of(picture), {}, 1));
}
Image inverse(const Image& spectrum) {
    configure_library();
    return image_of(OIIO::ImageBufAlgo::ifft(buffer_of(spectrum), {}, 1));
}

constexpr FourierTransform kFourier{.forward = forward, .inverse = inverse};

}  // namespace
}  // namespace patina

#ifdef _WIN32
#define PATINA_EXPORT __declspec(dllexport)
#else
#define PATINA_EXPORT __attribute__((visibility("default")))
#endif

extern "C" PATINA_EXPORT const patina::ImageCodec* patina_image_codec();
extern "C" PATINA_EXPORT const patina::ImageCodec* patina_image_codec() { return &patina::kCodec; }

extern "C" PATINA_EXPORT const patina::FourierTransform* patina_fourier_transform();
extern "C" PATINA_EXPORT const patina::FourierTransform* patina_fourier_transform() {
    return &patina::kFourier;
}
