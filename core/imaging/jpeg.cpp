#include "core/imaging/jpeg.h"

#include "core/imaging/reused_memory.h"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

#include <turbojpeg.h>

namespace goalmouth {
namespace {

constexpr int largest_side = 16384;  // as image_t has it

struct Destroy {
    void operator()(void* handle) const { tjDestroy(handle); }
};
using Codec = std::unique_ptr<void, Destroy>;

Codec opened(tjhandle handle) {
    if (handle == nullptr) throw std::runtime_error("the JPEG codec does not start");
    return Codec(handle);
}

[[noreturn]] void fail(const Codec& codec, const char* doing) {
    throw std::runtime_error(std::string(doing) + ": " + tjGetErrorStr2(codec.get()));
}

/// Three planes as the codec wants them: rows padded to whole chroma samples.
struct Planes {
    std::vector<std::uint8_t> samples[3];
    unsigned char* data[3] = {nullptr, nullptr, nullptr};
    int strides[3] = {0, 0, 0};

    Planes() = default;
    Planes(int width, int height, int subsampling) { resize(width, height, subsampling); }
    void resize(int width, int height, int subsampling) {
        const int count = subsampling == TJSAMP_GRAY ? 1 : 3;
        for (int i = 0; i < count; ++i) {
            strides[i] = tjPlaneWidth(i, width, subsampling);
            fit(samples[i], static_cast<std::size_t>(strides[i]) *
                                static_cast<std::size_t>(tjPlaneHeight(i, height, subsampling)));
            data[i] = samples[i].data();
        }
    }
    const std::uint8_t* row(int plane, int y) const {
        return samples[plane].data() + static_cast<std::ptrdiff_t>(y) * strides[plane];
    }
};

struct Header {
    int width = 0;
    int height = 0;
    int subsampling = 0;
};

Header header_of(const Codec& codec, std::span<const std::uint8_t> jpeg) {
    Header header;
    int colourspace = 0;
    if (tjDecompressHeader3(codec.get(), jpeg.data(), jpeg.size(), &header.width, &header.height,
                            &header.subsampling, &colourspace) != 0) {
        fail(codec, "not a JPEG");
    }
    if (header.width < 1 || header.height < 1 || header.width > largest_side || header.height > largest_side)
        throw std::runtime_error("a JPEG of impossible size");
    if ((colourspace != TJCS_YCbCr && colourspace != TJCS_GRAY) || header.subsampling < 0 ||
        header.subsampling >= TJ_NUMSAMP) {
        throw std::runtime_error("a JPEG that is neither YCbCr nor grey");
    }
    return header;
}

void interleave(const Planes& planes, const Header& header, std::uint8_t* out) {
    const bool grey = header.subsampling == TJSAMP_GRAY;
    const int columns_per_chroma = grey ? 1 : tjMCUWidth[header.subsampling] / 8;
    const int rows_per_chroma = grey ? 1 : tjMCUHeight[header.subsampling] / 8;
    const int last_x = header.width - 1;
    for (int y = 0; y < header.height; ++y) {
        const std::uint8_t* luma = planes.row(0, y);
        const std::uint8_t* cb = grey ? nullptr : planes.row(1, y / rows_per_chroma);
        const std::uint8_t* cr = grey ? nullptr : planes.row(2, y / rows_per_chroma);
        for (int x = 0; x < header.width; x += 2, out += 4) {
            const int next = std::min(x + 1, last_x);
            out[0] = luma[x];
            out[1] = out[3] = 128;
            out[2] = luma[next];
            if (grey) continue;
            const int left = x / columns_per_chroma;
            const int right = next / columns_per_chroma;
            out[1] = static_cast<std::uint8_t>((cb[left] + cb[right] + 1) / 2);
            out[3] = static_cast<std::uint8_t>((cr[left] + cr[right] + 1) / 2);
        }
    }
}

}  // namespace

struct JpegDecoder::State {
    Codec codec = opened(tjInitDecompress());
    Planes planes;
};

JpegDecoder::JpegDecoder() : state_(std::make_unique<State>()) {}
JpegDecoder::~JpegDecoder() = default;

JpegDecoder::Size JpegDecoder::size_of(std::span<const std::uint8_t> jpeg) {
    const Header header = header_of(state_->codec, jpeg);
    return {header.width, header.height};
}

void JpegDecoder::decode(std::span<const std::uint8_t> jpeg, std::span<std::uint8_t> to) {
    auto& [codec, planes] = *state_;
    const Header header = header_of(codec, jpeg);
    if (to.size() !=
        static_cast<std::size_t>(yuyv_row_bytes(header.width)) * static_cast<std::size_t>(header.height))
        throw std::invalid_argument("a JPEG decoded into memory of another size");
    planes.resize(header.width, header.height, header.subsampling);
    if (tjDecompressToYUVPlanes(codec.get(), jpeg.data(), jpeg.size(), planes.data, header.width,
                                planes.strides, header.height, 0) != 0) {
        // Webcams pad their frames and get away with it; half an image does not.
        const std::string warning = tjGetErrorStr2(codec.get());
        const bool whole =
            tjGetErrorCode(codec.get()) == TJERR_WARNING && warning.find("extraneous") != std::string::npos;
        if (!whole) throw std::runtime_error("a damaged JPEG: " + warning);
    }
    interleave(planes, header, to.data());
}

YuyvImage yuyv_from_jpeg(std::span<const std::uint8_t> jpeg) {
    JpegDecoder decoder;
    const auto [width, height] = decoder.size_of(jpeg);
    YuyvImage image(width, height);
    decoder.decode(jpeg, image.data);
    return image;
}

std::vector<std::uint8_t> jpeg_from_yuyv(const YuyvView& image, int quality) {
    if (image.empty()) throw std::invalid_argument("an empty image cannot become a JPEG");
    Planes planes(image.width, image.height, TJSAMP_422);
    for (int y = 0; y < image.height; ++y) {
        const std::uint8_t* in = image.row(y);
        const auto offset = static_cast<std::ptrdiff_t>(y);
        std::uint8_t* luma = planes.data[0] + offset * planes.strides[0];
        std::uint8_t* cb = planes.data[1] + offset * planes.strides[1];
        std::uint8_t* cr = planes.data[2] + offset * planes.strides[2];
        for (int pair = 0; pair < (image.width + 1) / 2; ++pair, in += 4) {
            luma[2 * pair] = in[0];
            luma[2 * pair + 1] = in[2];
            cb[pair] = in[1];
            cr[pair] = in[3];
        }
    }
    const Codec codec = opened(tjInitCompress());
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    const unsigned char* data[3] = {planes.data[0], planes.data[1], planes.data[2]};
    const int failed = tjCompressFromYUVPlanes(codec.get(), data, image.width, planes.strides, image.height,
                                               TJSAMP_422, &bytes, &size, std::clamp(quality, 1, 100), 0);
    const std::unique_ptr<unsigned char, decltype(&tjFree)> owned(bytes, &tjFree);
    if (failed != 0) fail(codec, "the JPEG codec failed");
    return {bytes, bytes + size};
}

}  // namespace goalmouth
