// Radiance HDR images: run-length encoding, and files that are broken.
#include "base/error.h"
#include "base/file.h"
#include "base/image_file.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace reflet::hdr_test {
namespace {

const std::string header = "#?RADIANCE\n# a comment\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=1\n\n";

/// The image of a file with this content after the header, or the error without the file's name.
struct Read {
    FloatImage image;
    std::string error;
};

Read readBack(const std::string& body) {
    const auto path = std::filesystem::path(::testing::TempDir()) / "reflet_hdr_test.hdr";
    writeFileAtomically(path, header + body);
    Read read;
    try {
        read.image = readHdr(path);
    } catch (const Error& error) {
        read.error = error.what();
        EXPECT_TRUE(read.error.starts_with(path.string() + ": cannot be read as an image: ")) << read.error;
        read.error.erase(0, read.error.find("image: ") + 7);
    }
    std::filesystem::remove(path);
    return read;
}

/// A scanline of 8 pixels: red 1 to 8 copied, green 64 and blue 0 as runs, exponents 129 as two runs.
const std::string scanline("\x02\x02\x00\x08\x08\x80\x02\x03\x04\x05\x06\x07\x80\x88\x40\x88\x00\x83\x81\x85\x81", 21);
const std::string twoLines = "-Y 2 +X 8\n" + scanline + scanline;

TEST(Hdr, RunsAndCopiesAreDecoded) {
    const Read read = readBack(twoLines);
    ASSERT_EQ(read.error, "");
    ASSERT_EQ(read.image.data.size(), 48U);
    for (size_t i = 0; i < 16; ++i) {
        const std::array<float, 8> red{1.0F, 2 / 128.0F, 3 / 128.0F, 4 / 128.0F, 5 / 128.0F, 6 / 128.0F, 7 / 128.0F, 1};
        EXPECT_EQ(read.image.data[3 * i], red.at(i % 8));
        EXPECT_EQ(read.image.data[3 * i + 1], 0.5F);
        EXPECT_EQ(read.image.data[3 * i + 2], 0.0F);
    }
}

TEST(Hdr, CutOffAnywhereIsAnError) {
    for (size_t length = 0; length < twoLines.size(); ++length) {
        EXPECT_NE(readBack(twoLines.substr(0, length)).error, "") << length;
    }
}

TEST(Hdr, BrokenFilesSayWhatIsWrong) {
    EXPECT_EQ(readBack("-Y 0 +X 8\n").error, "it has 8 x 0 pixels, but each side must have 1 to 65536");
    EXPECT_EQ(readBack("-Y 1 +X 0\n").error, "it has 0 x 1 pixels, but each side must have 1 to 65536");
    EXPECT_EQ(readBack("-Y 1 +X -8\n").error, "its size must be '-Y HEIGHT +X WIDTH', is '-Y 1 +X -8'");
    EXPECT_EQ(readBack("+Y 1 +X 8\n").error, "its size must be '-Y HEIGHT +X WIDTH', is '+Y 1 +X 8'");
    EXPECT_EQ(readBack("-Y 50000 +X 50000\n").error.substr(0, 34), "it takes 37.3 GiB to decode 50000 ");
    EXPECT_EQ(readBack("-Y 30000 +X 4000\n").error,
              "it is truncated: 4000 x 30000 pixels do not fit into 0 bytes");  // before memory is taken
    std::string tooLong = twoLines;
    tooLong[14] = '\x09';  // a copy beyond the end of the scanline
    EXPECT_EQ(readBack(tooLong).error, "a run does not fit into its scanline");
    tooLong[14] = '\x00';
    EXPECT_EQ(readBack(tooLong).error, "a run does not fit into its scanline");
    std::string otherWidth = twoLines;
    otherWidth[13] = '\x09';
    EXPECT_EQ(readBack(otherWidth).error, "a scanline has 9 pixels, the image 8");
    EXPECT_EQ(readBack("-Y 1 +X 2\n\x01\x01\x01\x02\x01\x01\x01\x02").error,
              "it has runs of an old encoding: convert it");
}

TEST(Hdr, DamagedBytesNeverDoMoreThanThrow) {
    std::mt19937 random(1);
    int errors = 0;
    for (int i = 0; i < 2000; ++i) {
        std::string bytes = twoLines;
        bytes[random() % bytes.size()] = static_cast<char>(random());
        bytes[random() % bytes.size()] = static_cast<char>(random());
        const Read read = readBack(bytes);
        errors += read.error.empty() ? 0 : 1;
        EXPECT_EQ(read.image.data.size(), size_t{3} * read.image.width * read.image.height);
    }
    EXPECT_GT(errors, 100);
}

}  // namespace
}  // namespace reflet::hdr_test
