// OpenEXR pictures through OpenEXR, from and to memory; a header alone from the file.
#include "renderer/core/exr_structure.h"
#include "renderer/core/file_io.h"
#include "renderer/core/image_channels.h"
#include "renderer/core/image_codec.h"

#include <IexBaseExc.h>
#include <IlmThreadPool.h>
#include <ImfChannelList.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <tuple>

namespace patina {
namespace {

using Bytes = std::span<const std::byte>;

/// Helpers that share the unpacking of one file's blocks; started with the first file.
int helper_threads() {
    static const int count = [] {
        const auto useful = static_cast<int>(IlmThread::ThreadPool::estimateThreadCountForFileIO());
        Imf::setGlobalThreadCount(std::clamp(useful, 0, 4));
        return Imf::globalThreadCount();
    }();
    return count;
}

class MemoryInput : public Imf::IStream {
public:
    explicit MemoryInput(Bytes bytes) : Imf::IStream("memory"), bytes_(bytes) {}
    bool isMemoryMapped() const override { return true; }
    char* readMemoryMapped(int size) override {
        if (size < 0 || static_cast<std::size_t>(size) > bytes_.size() - at_)
            throw Iex::InputExc("the file ends too early");
        const std::byte* first = bytes_.data() + at_;
        at_ += static_cast<std::size_t>(size);
        // NOLINTNEXTLINE: OpenEXR only reads through it
        return const_cast<char*>(reinterpret_cast<const char*>(first));
    }
    bool read(char target[], int size) override {
        std::memcpy(target, readMemoryMapped(size), static_cast<std::size_t>(size));
        return at_ < bytes_.size();
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t position) override {
        if (position > bytes_.size()) throw Iex::InputExc("the file ends too early");
        at_ = static_cast<std::size_t>(position);
    }
    void clear() override {}

private:
    Bytes bytes_;
    std::size_t at_ = 0;
};

class MemoryOutput : public Imf::OStream {
public:
    explicit MemoryOutput(std::vector<std::byte>& bytes) : Imf::OStream("memory"), bytes_(bytes) {}
    void write(const char source[], int size) override {
        const std::size_t end = at_ + static_cast<std::size_t>(size);
        if (end > bytes_.size()) bytes_.resize(end);
        std::memcpy(bytes_.data() + at_, source, static_cast<std::size_t>(size));
        at_ = end;
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t position) override { at_ = static_cast<std::size_t>(position); }

private:
    std::vector<std::byte>& bytes_;
    std::size_t at_ = 0;
};

// --- which part and which channels ---

/// A layer's channels one after the other, red, green, blue and alpha first: OpenEXR lists them by the
/// alphabet.
std::vector<std::string> channel_names(const Imf::Header& header) {
    std::vector<std::string> names;
    for (auto it = header.channels().begin(); it != header.channels().end(); ++it)
        names.emplace_back(it.name());
    const auto key = [](const std::string& name) {
        const std::size_t dot = name.rfind('.');
        const std::string last = dot == std::string::npos ? name : name.substr(dot + 1);
        constexpr std::string_view order = "RGBA";
        const std::size_t place =
            last.size() == 1 ? std::min(order.find(last[0]), order.size()) : order.size();
        return std::tuple(dot == std::string::npos ? std::string() : name.substr(0, dot), place, last);
    };
    std::sort(names.begin(), names.end(),
              [&](const std::string& a, const std::string& b) { return key(a) < key(b); });
    return names;
}

struct Part {
    int index = 0;
    std::vector<std::string> names;
    ChannelChoice choice;
};

/// The first with colours, else the first with luminance, else the first.
Part choose_part(const Imf::MultiPartInputFile& input) {
    Part best;
    for (int index = 0; index < std::min(input.parts(), 64) && best.choice.rank < 3; ++index) {
        Part part{.index = index, .names = channel_names(input.header(index))};
        if (part.names.empty()) continue;
        part.choice = choose_channels(part.names);
        if (part.choice.rank > best.choice.rank) best = std::move(part);
    }
    if (best.choice.rank == 0) throw std::runtime_error("has no channels; export it again");
    return best;
}

struct Window {
    std::int64_t x = 0, y = 0, width = 0, height = 0;
    bool operator==(const Window&) const = default;
};
Window window_of(const Imath::Box2i& box) {
    return {box.min.x, box.min.y, std::int64_t{box.max.x} - box.min.x + 1,
            std::int64_t{box.max.y} - box.min.y + 1};
}

void check(const Imf::Header& header, const Part& part) {
    for (const Window& window : {window_of(header.dataWindow()), window_of(header.displayWindow())})
        if (const std::string problem = size_problem(window.width, window.height); !problem.empty())
            throw std::runtime_error(problem);
    if (header.hasType() && Imf::isDeepData(header.type()))
        throw std::runtime_error("holds deep data; flatten it");
    for (const int channel : part.choice.channels) {
        const Imf::Channel& stored = header.channels()[part.names[static_cast<std::size_t>(channel)]];
        if (stored.xSampling != 1 || stored.ySampling != 1)
            throw std::runtime_error(
                "has channels at a part of its resolution; export it with all at full size");
    }
}

// --- reading ---

/// Names that other formats give the same thing.
std::string common_name(const std::string& name) {
    constexpr std::array<std::array<std::string_view, 2>, 4> names{
        {{"expTime", "ExposureTime"},
         {"aperture", "FNumber"},
         {"isoSpeed", "Exif:PhotographicSensitivity"},
         {"capDate", "DateTime"}}};
    for (const auto& [own, common] : names)
        if (name == own) return std::string(common);
    return name;
}

ImageMetadata metadata_of(const Imf::Header& header) {
    ImageMetadata metadata;
    for (auto it = header.begin(); it != header.end(); ++it) {
        const std::string name = common_name(it.name());
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute()))
            metadata.emplace_back(name, text->value());
        else if (const auto* real = dynamic_cast<const Imf::FloatAttribute*>(&it.attribute()))
            metadata.emplace_back(name, std::to_string(real->value()));
        else if (const auto* whole = dynamic_cast<const Imf::IntAttribute*>(&it.attribute()))
            metadata.emplace_back(name, std::to_string(whole->value()));
    }
    return metadata;
}

ExrStructure sound_structure(Bytes start, std::uint64_t file_bytes) {
    ExrStructure structure = exr_structure(start, file_bytes);
    if (!structure.problem.empty()) throw std::runtime_error(structure.problem);
    return structure;
}

/// Reads no more of the file than its headers take, as far as can be told.
void check_headers(const std::filesystem::path& file) {
    constexpr std::uint64_t usual = 1 << 16;
    const std::vector<std::byte> start = read_file(file, usual);
    if (sound_structure(start, std::filesystem::file_size(file)).header_bytes > 0) return;
    const std::vector<std::byte> whole = read_file(file);
    sound_structure(whole, whole.size());
}

DecodedHeader header(const ImageSource& source) {
    check_headers(source.file);
    const Imf::MultiPartInputFile input(path_text(source.file).c_str(), 0);
    const Part part = choose_part(input);
    const Imf::Header& own = input.header(part.index);
    check(own, part);
    const Window window = window_of(own.displayWindow());
    return {.info = {.width = static_cast<int>(window.width),
                     .height = static_cast<int>(window.height),
                     .channels = static_cast<int>(part.choice.channels.size()),
                     .type = PixelType::F32,
                     .format = "openexr"},
            .metadata = metadata_of(own)};
}

Image read_part(Imf::MultiPartInputFile& input, const Part& part) {
    const Imath::Box2i box = input.header(part.index).dataWindow();
    const Window window = window_of(box);
    Image image = make_image(static_cast<int>(window.width), static_cast<int>(window.height),
                             static_cast<int>(part.choice.channels.size()), PixelType::F32);
    const std::size_t pixel = part.choice.channels.size() * sizeof(float);
    Imf::FrameBuffer target;
    for (std::size_t i = 0; i < part.choice.channels.size(); ++i)
        target.insert(part.names[static_cast<std::size_t>(part.choice.channels[i])],
                      Imf::Slice::Make(Imf::FLOAT, image.bytes.data() + i * sizeof(float), box, pixel,
                                       pixel * static_cast<std::size_t>(window.width)));
    Imf::InputPart pixels(input, part.index);
    pixels.setFrameBuffer(target);
    pixels.readPixels(box.min.y, box.max.y);
    return image;
}

DecodedImage decode(const ImageSource& source) {
    sound_structure(source.bytes, source.bytes.size());
    MemoryInput stream(source.bytes);
    Imf::MultiPartInputFile input(stream, helper_threads());
    const Part part = choose_part(input);
    const Imf::Header& own = input.header(part.index);
    check(own, part);
    // The display window is allocated, too, whatever the pixels cover.
    for (const Window& window : {window_of(own.dataWindow()), window_of(own.displayWindow())})
        if (!can_hold(ImageFormat::OpenExr, source.bytes.size(),
                      static_cast<std::uint64_t>(window.width) * static_cast<std::uint64_t>(window.height)))
            throw std::runtime_error("promises more pixels than it holds; copy or export it again");
    if (!input.partComplete(part.index)) throw std::runtime_error("is cut short; copy or export it again");
    DecodedImage decoded{.loaded = {.image = read_part(input, part)}};
    std::vector<std::string>& notes = decoded.loaded.notes;
    if (part.index > 0)
        notes.push_back("part " + std::to_string(part.index + 1) + " (\"" +
                        (own.hasName() ? own.name() : "") + "\") was read, the first one with colours");
    if (std::string note = left_out_note(part.names, part.choice); !note.empty())
        notes.push_back(std::move(note));
    const Window data = window_of(own.dataWindow());
    const Window display = window_of(own.displayWindow());
    if (data == display) return decoded;
    decoded.loaded.image = placed(decoded.loaded.image, {.x = static_cast<int>(data.x - display.x),
                                                         .y = static_cast<int>(data.y - display.y),
                                                         .width = static_cast<int>(display.width),
                                                         .height = static_cast<int>(display.height)});
    notes.emplace_back(
        "its pixels do not cover the display window exactly; the rest was filled with black or cut off");
    return decoded;
}

}  // namespace

const ImageCodec& exr_codec() {
    static constexpr ImageCodec codec{.header = header, .decode = decode};
    return codec;
}

std::vector<std::byte> encode_exr(const Image& image, const ImageMetadata& metadata) {
    constexpr std::array<std::array<const char*, 4>, 4> names{
        {{"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}}};
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const auto& [key, value] : metadata) header.insert(key, Imf::StringAttribute(value));
    const auto channels = static_cast<std::size_t>(image.channels);
    const std::size_t pixel = channels * sizeof(float);
    Imf::FrameBuffer source;
    // NOLINTNEXTLINE: OpenEXR only reads through it
    auto* first = const_cast<char*>(reinterpret_cast<const char*>(image.bytes.data()));
    for (std::size_t i = 0; i < channels; ++i) {
        const char* name = names[channels - 1][i];
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        source.insert(name, Imf::Slice(Imf::FLOAT, first + i * sizeof(float), pixel,
                                       pixel * static_cast<std::size_t>(image.width)));
    }
    std::vector<std::byte> bytes;
    MemoryOutput stream(bytes);
    {
        Imf::OutputFile output(stream, header, helper_threads());
        output.setFrameBuffer(source);
        output.writePixels(image.height);
    }  // the table of offsets is written when the file is closed
    return bytes;
}

}  // namespace patina
