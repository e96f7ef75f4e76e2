// Broken images that crash or mislead the libraries that decode them: all of them found by fuzzing.
#include "base/error.h"
#include "base/file.h"
#include "base/image_file.h"
#include "gltf_encoders.h"

#include <gtest/gtest.h>
#include <stb/stb_image_write.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <numeric>

#include <jpeglib.h>

namespace reflet::test::image_broken_test {
namespace {

/// The error without the file's name; empty: there is none.
std::string complaintOf(const std::string& name, const std::string& bytes) {
    const auto path = testFolder() / name;
    writeFileAtomically(path, bytes);
    try {
        if (name.ends_with(".exr")) {
            (void)readExr(path);
        } else {
            (void)readBitmap(path);
        }
    } catch (const Error& error) {
        return std::string(error.what()).substr(path.string().size() + 2);
    }
    return "";
}

std::string textureComplaint(const std::string& bytes) {
    GltfBuilder b = triangle();
    b.add("materials", {{"pbrMetallicRoughness",
                         {{"baseColorTexture", {{"index", addTextureOf(b, {bytes.begin(), bytes.end()})}}}}}});
    b.document["meshes"][0]["primitives"][0]["material"] = 0;
    return complaint(b.writeGlb(testFolder() / "scene.glb"));
}

std::string jpegOf(int width, int height) {
    const std::vector<uint8_t> pixels(static_cast<size_t>(width) * static_cast<size_t>(height) * 3, 90);
    std::string jpeg;
    stbi_write_jpg_to_func(
        [](void* context, void* data, int size) {
            static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<size_t>(size));
        },
        &jpeg, width, height, 3, pixels.data(), 90);
    return jpeg;
}

TEST(BrokenImage, OfAnotherFormatIsNotDecoded) {
    EXPECT_EQ(complaintOf("a.png", "GIF89a\x01\x01"), "cannot be read as an image: it is neither PNG nor JPEG");
    EXPECT_EQ(complaintOf("a.jpg", std::string("8BPS\0\1", 6)),
              "cannot be read as an image: it is neither PNG nor JPEG");
}

TEST(BrokenImage, TheNameOfAPngChunkCannotBreakTheMessage) {
    const std::vector<uint8_t> bytes = pngOf(2, 2, {1, 2, 3, 4});
    std::string png(bytes.begin(), bytes.end());
    png.replace(png.find("IDAT"), 4, "ID\nT");
    const std::string message = complaintOf("a.png", png);
    EXPECT_TRUE(message.starts_with("cannot be read as an image: ")) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST(BrokenImage, APngChunkThatClaimsMoreThanTheFileHasTakesNoMemory) {
    const std::vector<uint8_t> bytes = pngOf(2, 2, {1, 2, 3, 4});
    std::string png(bytes.begin(), bytes.end());
    png.replace(png.find("IDAT") - 4, 4, std::string("\x3F\xFF\xFF\xFF", 4));
    EXPECT_TRUE(complaintOf("a.png", png).starts_with("cannot be read as an image: ")) << complaintOf("a.png", png);
    EXPECT_TRUE(textureComplaint(png).starts_with("images[0]: is a broken image: ")) << textureComplaint(png);
}

class BrokenExr : public ::testing::Test {
protected:
    BrokenExr() {
        const auto path = testFolder() / "whole.exr";
        writeExr(path, std::vector<ImageLayer>{{"", {2, 1, {"R", "G", "B"}, std::vector<float>(6, 0.5F)}}});
        whole_ = readFile(path);
    }

    /// The error, with one more attribute. There is always one: pixels move, too.
    [[nodiscard]] std::string complaintWith(const std::string& type, const std::string& length,
                                            const std::string& value) const {
        const std::string zero(1, '\0');
        return complaintOf("a.exr",
                           whole_.substr(0, 8) + "extra" + zero + type + zero + length + value + whole_.substr(8));
    }

    const std::string broken_ = "cannot be read as EXR: its header is broken";
    std::string whole_;
};

std::string word(uint32_t value) {
    std::string bytes(4, '\0');
    std::memcpy(bytes.data(), &value, 4);
    return bytes;
}

TEST_F(BrokenExr, AnAttributeThatClaimsMoreThanTheFileHasTakesNoMemory) {
    EXPECT_NE(complaintWith("odd", word(1), "x"), broken_);
    EXPECT_EQ(complaintWith("odd", word(0x7FFFFFFF), "x"), broken_);
    EXPECT_EQ(complaintWith("odd", word(0xFFFFFFFF), "x"), broken_);
    EXPECT_NE(complaintWith("string", word(3), "abc"), broken_);
    EXPECT_EQ(complaintWith("string", word(0x7FFFFFFF), "abc"), broken_);
}

TEST_F(BrokenExr, AnAttributeHasTheLengthOfItsType) {  // OpenEXR reads by the type, not by the length
    EXPECT_NE(complaintWith("v2i", word(8), word(1) + word(2)), broken_);
    EXPECT_EQ(complaintWith("v2i", word(9), word(1) + word(2) + "x"), broken_);
}

TEST_F(BrokenExr, LengthsInsideOfAnAttributeFitIt) {
    EXPECT_NE(complaintWith("stringvector", word(6), word(2) + "ab"), broken_);
    EXPECT_EQ(complaintWith("stringvector", word(6), word(0x7FFFFFFF) + "ab"), broken_);
    EXPECT_NE(complaintWith("preview", word(12), word(1) + word(1) + "rgba"), broken_);
    EXPECT_EQ(complaintWith("preview", word(12), word(65536) + word(65536) + "rgba"), broken_);
    const std::string channel = std::string("A\0", 2) + word(1) + word(0) + word(1) + word(1);
    EXPECT_NE(complaintWith("chlist", word(19), channel + std::string(1, '\0')), broken_);
    EXPECT_EQ(complaintWith("chlist", word(18), channel), broken_);
}

TEST(BrokenImage, APngTextureNeedsItsHeader) {
    const std::vector<uint8_t> png = pngOf(2, 2, {1, 2, 3, 4});
    EXPECT_EQ(textureComplaint(std::string(png.begin(), png.end())), "");
    for (size_t length = 16; length < 26; ++length) {
        EXPECT_EQ(textureComplaint(std::string(png.begin(), png.begin() + static_cast<std::ptrdiff_t>(length))),
                  "images[0]: is a broken image: its header is truncated");
    }
}

TEST(BrokenImage, APngWhoseBytesDoNotFitTheirChecksumIsNotDecoded) {
    const std::vector<uint8_t> bytes = pngOf(2, 2, {1, 2, 3, 4});
    std::string png(bytes.begin(), bytes.end());
    png.at(png.find("IDAT") + 8) ^= 1;
    EXPECT_TRUE(complaintOf("a.png", png).starts_with("cannot be read as an image: ")) << complaintOf("a.png", png);
}

/// Of rows of values that grow by one; progressive, or, with four channels, CMYK as Adobe's programs store it.
std::string libraryJpeg(uint32_t size, int channels = 3) {
    jpeg_error_mgr errors{};
    jpeg_compress_struct jpeg{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* bytes = nullptr;
    unsigned long length = 0;
    jpeg_mem_dest(&jpeg, &bytes, &length);
    jpeg.image_width = size;
    jpeg.image_height = size;
    jpeg.input_components = channels;
    jpeg.in_color_space = channels == 4 ? JCS_CMYK : JCS_RGB;
    jpeg_set_defaults(&jpeg);
    if (channels == 3) {
        jpeg_simple_progression(&jpeg);
    }
    jpeg_set_quality(&jpeg, 100, TRUE);
    jpeg_start_compress(&jpeg, TRUE);
    std::vector<uint8_t> pixels(size_t{size} * static_cast<size_t>(channels));
    std::iota(pixels.begin(), pixels.end(), uint8_t{0});
    JSAMPROW row = pixels.data();
    while (jpeg.next_scanline < jpeg.image_height) {
        (void)jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    const std::unique_ptr<unsigned char, decltype(&std::free)> owner(bytes, &std::free);
    return {reinterpret_cast<const char*>(bytes), length};
}

TEST(BrokenImage, AJpegHasNotMoreScansThanWritersMake) {  // each makes the decoder visit every block
    const std::string whole = libraryJpeg(32);
    const size_t last = whole.rfind("\xFF\xDA");
    const std::string scan = whole.substr(last, whole.size() - 2 - last);
    const auto withMoreScans = [&](int count) {
        std::string jpeg = whole.substr(0, whole.size() - 2);
        for (int i = 0; i < count; ++i) {
            jpeg += scan;
        }
        return jpeg + whole.substr(whole.size() - 2);
    };
    EXPECT_EQ(complaintOf("a.jpg", withMoreScans(0)), "");
    EXPECT_EQ(complaintOf("a.jpg", withMoreScans(20)), "");
    EXPECT_EQ(complaintOf("a.jpg", withMoreScans(40)), "cannot be read as an image: it has too many scans");
    EXPECT_EQ(textureComplaint(withMoreScans(40)), "images[0]: is a broken image: it has too many scans");
}

TEST(BrokenImage, AJpegWhoseRowsAreMissingIsNotDecoded) {  // the decoder would make them grey, with a warning
    for (const std::string& whole : {jpegOf(64, 64), libraryJpeg(64)}) {
        EXPECT_EQ(complaintOf("a.jpg", whole.substr(0, whole.size() - 2)), "") << "without an end of image";
        const std::string half = whole.substr(0, whole.rfind("\xFF\xDA") + 20);
        EXPECT_EQ(complaintOf("a.jpg", half), "cannot be read as an image: its data end before the last row");
        EXPECT_EQ(textureComplaint(half), "images[0]: is a broken image: its data end before the last row");
    }
}

TEST(BrokenImage, AJpegOfFourInksIsRgb) {
    const auto file = testFolder() / "a.jpg";
    writeFileAtomically(file, libraryJpeg(32, 4));
    const Bitmap bitmap = readBitmap(file);
    ASSERT_EQ(bitmap.channels, 3U);
    for (size_t x = 0; x < 32; ++x) {  // of values 4x to 4x + 3, the last is the key
        for (size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(bitmap.data.at(3 * x + c), (4 * x + c) * (4 * x + 3) / 255.0, 3.0) << x;
        }
    }
}

TEST(BrokenImage, AJpegWithoutTablesHasTheStandardOnes) {  // as frames of Motion JPEG
    const std::string whole = jpegOf(8, 8);
    std::string jpeg = whole;
    const size_t tables = jpeg.find("\xFF\xC4");
    jpeg[tables + 1] = '\xEC';  // a segment that decoders skip
    EXPECT_EQ(complaintOf("a.jpg", jpeg), "");
    EXPECT_EQ(textureComplaint(jpeg), "");
}

TEST(BrokenImage, AHuffmanTableOfAJpegHasAtMost256Codes) {
    std::string jpeg = jpegOf(8, 8);
    const size_t tables = jpeg.find("\xFF\xC4") + 4;
    jpeg.replace(tables + 1, 16, std::string(16, '\x40'));
    EXPECT_EQ(complaintOf("a.jpg", jpeg), "cannot be read as an image: Bogus Huffman table definition");
}

}  // namespace
}  // namespace reflet::test::image_broken_test
