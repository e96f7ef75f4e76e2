#include "base/jpeg.h"

#include "base/error.h"
#include "base/limits.h"
#include "base/message.h"

#include <array>
#include <csetjmp>
#include <cstdio>
#include <new>

#include <jpeglib.h>

#include <jerror.h>

namespace reflet {

namespace {

/// libjpeg-turbo calls a function that must not return when it cannot go on: it jumps back into the method of Reader
/// that called the library. Nothing between has a destructor.
class Reader {
public:
    explicit Reader(std::span<const uint8_t> bytes) : bytes_(bytes) {
        jpeg_.err = jpeg_std_error(&errors_.manager);
        errors_.manager.error_exit = [](j_common_ptr jpeg) {
            auto* errors = reinterpret_cast<Errors*>(jpeg->err);
            errors->manager.format_message(jpeg, errors->text.data());
            std::longjmp(errors->back, 1);
        };
        errors_.manager.emit_message = [](j_common_ptr jpeg, int level) {
            auto* errors = reinterpret_cast<Errors*>(jpeg->err);
            errors->noMoreBytes |= level < 0 && errors->manager.msg_code == JWRN_JPEG_EOF;
            errors->rowsMissing |= level < 0 && errors->manager.msg_code == JWRN_HIT_MARKER;
        };
        progress_.progress_monitor = [](j_common_ptr jpeg) {
            constexpr int mostScans = 32;  // writers of progressive images make about ten
            if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number > mostScans) {
                auto* errors = reinterpret_cast<Errors*>(jpeg->err);
                errors->tooManyScans = true;
                std::longjmp(errors->back, 1);
            }
        };
    }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    Reader(Reader&&) = delete;
    Reader& operator=(Reader&&) = delete;
    ~Reader() { jpeg_destroy_decompress(&jpeg_); }

    void readHeader() {
        if (!tryHeader()) {
            failWithReason();
        }
    }

    /// To four channels: RGBA, or CMYK as it is stored.
    void decode(std::vector<uint8_t>& pixels) {
        if (!tryDecode(pixels.data())) {
            failWithReason();
        }
        // Either alone is harmless: an absent end of image, and a strip that was damaged.
        if (errors_.noMoreBytes && errors_.rowsMissing) {
            fail("its data end before the last row");
        }
    }

    [[nodiscard]] const jpeg_decompress_struct& state() const { return jpeg_; }
    [[nodiscard]] bool fourInks() const { return jpeg_.num_components == 4; }

private:
    struct Errors {
        jpeg_error_mgr manager{};  // first: the library knows the address of this one
        std::jmp_buf back{};
        std::array<char, JMSG_LENGTH_MAX> text{};
        bool tooManyScans = false;
        bool noMoreBytes = false;
        bool rowsMissing = false;
    };

    // NOLINTBEGIN(cert-err52-cpp): the library has no other way
    bool tryHeader() {
        if (setjmp(errors_.back) != 0) {
            return false;
        }
        jpeg_create_decompress(&jpeg_);
        jpeg_mem_src(&jpeg_, bytes_.data(), bytes_.size());
        (void)jpeg_read_header(&jpeg_, TRUE);
        return true;
    }

    bool tryDecode(uint8_t* out) {
        if (setjmp(errors_.back) != 0) {
            return false;
        }
        jpeg_.mem->max_memory_to_use = static_cast<long>(memoryLimit() / 4);
        jpeg_.progress = &progress_;
        jpeg_.out_color_space = fourInks() ? JCS_CMYK : JCS_EXT_RGBA;
        (void)jpeg_start_decompress(&jpeg_);
        while (jpeg_.output_scanline < jpeg_.output_height) {
            JSAMPROW row = out + size_t{jpeg_.output_scanline} * jpeg_.output_width * 4;
            (void)jpeg_read_scanlines(&jpeg_, &row, 1);
        }
        return true;
    }
    // NOLINTEND(cert-err52-cpp)

    [[noreturn]] void failWithReason() const {
        if (errors_.tooManyScans) {
            fail("it has too many scans");
        }
        if (errors_.manager.msg_code == JERR_OUT_OF_MEMORY || errors_.manager.msg_code == JERR_NO_BACKING_STORE) {
            throw std::bad_alloc();
        }
        fail("{}", errors_.text.data());
    }

    std::span<const uint8_t> bytes_;
    Errors errors_;
    jpeg_progress_mgr progress_{};
    jpeg_decompress_struct jpeg_{};
};

/// Adobe's programs store CMYK inverted, and are alone in writing it.
void toRgba(std::vector<uint8_t>& cmyk) {
    for (size_t i = 0; i < cmyk.size(); i += 4) {
        const uint32_t key = cmyk[i + 3];
        for (size_t c = 0; c < 3; ++c) {
            cmyk[i + c] = static_cast<uint8_t>((cmyk[i + c] * key + 127) / 255);
        }
        cmyk[i + 3] = 255;
    }
}

}  // namespace

EncodedImageHeader readJpegHeader(std::span<const uint8_t> bytes) {
    Reader reader(bytes);
    reader.readHeader();
    const jpeg_decompress_struct& jpeg = reader.state();
    return {.width = jpeg.image_width, .height = jpeg.image_height, .channels = jpeg.num_components == 1 ? 1U : 3U};
}

std::vector<uint8_t> decodeJpeg(std::span<const uint8_t> bytes, const EncodedImageHeader& header) {
    std::vector<uint8_t> rgba(size_t{header.width} * header.height * 4);
    Reader reader(bytes);
    reader.readHeader();
    reader.decode(rgba);
    if (reader.fourInks()) {
        toRgba(rgba);
    }
    return rgba;
}

}  // namespace reflet
