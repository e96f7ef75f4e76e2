// Files and image files: round trips, atomic writing, error messages.
#include "base/image_file.h"

#include "base/file.h"
#include "unit/message_of.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <limits>

namespace reflet::image_file_test {
namespace {

namespace fs = std::filesystem;
using test::messageOf;

/// An empty folder for one test.
class Files : public ::testing::Test {
public:
    Files(const Files&) = delete;
    Files& operator=(const Files&) = delete;
    Files(Files&&) = delete;
    Files& operator=(Files&&) = delete;

protected:
    Files() : folder_(fs::path(::testing::TempDir()) / "reflet_image_file_test" / testName()) {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    ~Files() override { fs::remove_all(folder_); }

    [[nodiscard]] fs::path at(const std::string& name) const { return folder_ / name; }
    [[nodiscard]] size_t fileCount() const {
        return static_cast<size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }

private:
    static std::string testName() { return ::testing::UnitTest::GetInstance()->current_test_info()->name(); }

    fs::path folder_;
};

using ImageFile = Files;
using ExrFile = Files;

/// Limits the size of written files during its lifetime, to simulate a full disk.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &old_);
        const rlimit limited{bytes, old_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limited);
    }
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &old_);
        (void)std::signal(SIGXFSZ, handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;
    FileSizeLimit(FileSizeLimit&&) = delete;
    FileSizeLimit& operator=(FileSizeLimit&&) = delete;

private:
    rlimit old_{};
    void (*handler_)(int);
};

Bitmap gradient(uint32_t width, uint32_t height, uint32_t channels) {
    Bitmap bitmap{width, height, channels, {}};
    for (uint32_t i = 0; i < width * height * channels; ++i) {
        bitmap.data.push_back(static_cast<uint8_t>(i * 37 + i / 7));
    }
    return bitmap;
}

FloatImage wave(uint32_t width, uint32_t height, std::vector<std::string> channels) {
    FloatImage image{width, height, std::move(channels), {}};
    for (size_t i = 0; i < size_t{width} * height * image.channels.size(); ++i) {
        image.data.push_back(1000.0F * std::sin(0.37F * static_cast<float>(i)));
    }
    return image;
}

void expectSame(const FloatImage& a, const FloatImage& b) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    EXPECT_EQ(a.channels, b.channels);
    EXPECT_EQ(a.data, b.data);
}

TEST_F(Files, AFileReadsBackAsItWasWritten) {
    const std::string content("a\0b\r\n\xff", 6);
    writeFileAtomically(at("x"), content);
    EXPECT_EQ(readFile(at("x")), content);
    writeFileAtomically(at("x"), "");
    EXPECT_EQ(readFile(at("x")), "");
    EXPECT_EQ(fileCount(), 1U);
}

TEST_F(Files, AMissingFolderIsNamedInTheError) {
    EXPECT_EQ(messageOf([&] { writeFileAtomically(at("out") / "x.png", "content"); }),
              at("out/x.png").string() + ": cannot be written: No such file or directory: create the folder '" +
                  at("out").string() + "' first");
}

TEST_F(Files, AFolderCannotBeWrittenAsAFile) {
    fs::create_directory(at("out"));
    for (const char* name : {"out", "out/"}) {
        EXPECT_EQ(messageOf([&] { writeFileAtomically(at(name), "content"); }),
                  at(name).string() + ": cannot be written: it is a folder; name a file in it");
    }
    EXPECT_TRUE(fs::is_empty(at("out")));
}

TEST_F(Files, AFolderOrAMissingFileCannotBeRead) {
    EXPECT_EQ(messageOf([&] { readFile(at("x")); }), at("x").string() + ": cannot be read: No such file or directory");
    EXPECT_EQ(messageOf([&] { readFile(at("")); }), at("").string() + ": cannot be read: Is a directory");
}

TEST_F(Files, AFailingWriteLeavesTheOldFileWholeAndNothingElse) {
    writeFileAtomically(at("x"), "old");
    const FileSizeLimit limit(10);
    EXPECT_EQ(messageOf([&] { writeFileAtomically(at("x"), "more than ten bytes"); }),
              at("x").string() + ": cannot be written: File too large");
    EXPECT_EQ(readFile(at("x")), "old");
    EXPECT_EQ(fileCount(), 1U);
}

TEST_F(Files, WithoutCommitNothingIsWritten) {
    for (const auto naming : {AtomicFile::Naming::whenWhole, AtomicFile::Naming::atOnce}) {
        {
            AtomicFile file(at("x"), naming);
            file.write("content");
            EXPECT_FALSE(fs::exists(at("x")));
        }
        EXPECT_EQ(fileCount(), 0U);
    }
}

TEST_F(Files, AreTheSameWithATemporaryName) {
    for (const char* content : {"old", "new"}) {
        AtomicFile file(at("x"), AtomicFile::Naming::atOnce);
        EXPECT_EQ(fileCount(), 1U + (fs::exists(at("x")) ? 1U : 0U));
        file.write(content);
        file.commit();
        EXPECT_EQ(readFile(at("x")), content);
        EXPECT_EQ(fileCount(), 1U);
    }
    AtomicFile another(at("x"), AtomicFile::Naming::atOnce);
    EXPECT_FALSE(another.commitNew());
}

// Where the file system can: then not even SIGKILL leaves a part of a file.
TEST_F(Files, HaveNoNameUntilTheyAreWhole) {
    const int unnamed = ::open(at("").c_str(), O_TMPFILE | O_WRONLY, 0600);
    if (unnamed < 0) {
        GTEST_SKIP() << "this file system has no files without a name";
    }
    ::close(unnamed);
    for (const char* content : {"old", "new"}) {
        AtomicFile file(at("x"));
        file.write(content);
        EXPECT_EQ(fileCount(), fs::exists(at("x")) ? 1U : 0U);
        file.commit();
        EXPECT_EQ(readFile(at("x")), content);
    }
    EXPECT_EQ(fileCount(), 1U);
}

TEST_F(Files, APipeThatNothingReadsIsAnErrorAndOneThatIsReadIsWritten) {
    ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
    EXPECT_EQ(messageOf([&] { writeFileAtomically(at("pipe"), "content"); }),
              at("pipe").string() + ": cannot be written: it is a socket, or a pipe that nothing reads");
    const int reader = ::open(at("pipe").c_str(), O_RDONLY | O_NONBLOCK);
    writeFileAtomically(at("pipe"), "content");
    std::array<char, 16> got{};
    EXPECT_EQ(::read(reader, got.data(), got.size()), 7);
    ::close(reader);
}

TEST_F(Files, OfANameThatCannotBeAreRefusedAtOnce) {
    fs::create_symlink("loop", at("loop"));
    for (const fs::path& name : {at("loop"), at(std::string(256, 'n'))}) {
        EXPECT_TRUE(messageOf([&] {
                        const AtomicFile file(name);
                    }).starts_with(messageText("{}: cannot be written: ", name.string())))
            << name;
    }
}

TEST_F(Files, ALinkKeepsPointingAtTheFileThatIsReplaced) {
    writeFileAtomically(at("target"), "old");
    fs::create_symlink("target", at("link"));
    writeFileAtomically(at("link"), "new");
    EXPECT_TRUE(fs::is_symlink(at("link")));
    EXPECT_EQ(readFile(at("target")), "new");
}

TEST_F(Files, ADeviceIsWrittenToAndNeverReplaced) {
    writeFileAtomically("/dev/null", "content");
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    EXPECT_EQ(messageOf([] { writeFileAtomically("/dev/full", "content"); }),
              "/dev/full: cannot be written: No space left on device");
}

TEST_F(ImageFile, APngReadsBackExactly) {
    for (const uint32_t channels : {3U, 4U}) {
        const Bitmap bitmap = gradient(17, 9, channels);
        writePng(at("x.png"), bitmap);
        const Bitmap back = readBitmap(at("x.png"));
        EXPECT_EQ(back.width, 17U);
        EXPECT_EQ(back.height, 9U);
        EXPECT_EQ(back.channels, channels);
        EXPECT_EQ(back.data, bitmap.data);
    }
}

TEST_F(ImageFile, ThePngOfOnePictureIsAlwaysTheSameBytes) {
    writePng(at("a.png"), gradient(30, 20, 3));
    writePng(at("b.png"), gradient(30, 20, 3));
    EXPECT_EQ(readFile(at("a.png")), readFile(at("b.png")));
}

TEST_F(ImageFile, APngThatDoesNotFitOnTheDiskLeavesTheOldOneWhole) {
    writePng(at("x.png"), gradient(2, 2, 3));
    const std::string old = readFile(at("x.png"));
    const FileSizeLimit limit(100);
    EXPECT_EQ(messageOf([&] { writePng(at("x.png"), gradient(100, 100, 3)); }),
              at("x.png").string() + ": cannot be written: File too large");
    EXPECT_EQ(readFile(at("x.png")), old);
    EXPECT_EQ(fileCount(), 1U);
}

TEST_F(ImageFile, ABitmapOfTheWrongLengthIsABug) {
    EXPECT_THROW(writePng(at("x.png"), Bitmap{2, 2, 3, std::vector<uint8_t>(11)}), std::logic_error);
    EXPECT_THROW(writePng(at("x.png"), Bitmap{}), std::logic_error);
}

TEST_F(ImageFile, ADamagedPngIsAnError) {
    writePng(at("x.png"), gradient(40, 40, 3));
    const std::string whole = readFile(at("x.png"));
    for (const size_t length : {size_t{0}, size_t{7}, size_t{20}, size_t{60}, whole.size() / 2, whole.size() - 20}) {
        writeFileAtomically(at("x.png"), whole.substr(0, length));
        EXPECT_TRUE(messageOf([&] { readBitmap(at("x.png")); }).starts_with(at("x.png").string() + ": cannot be read"))
            << length;
    }
}

TEST_F(ImageFile, ARadianceFileGivesItsValues) {
    const std::array<uint8_t, 8> rgbe{128, 64, 0, 129, 128, 128, 128, 132};
    writeFileAtomically(at("x.hdr"), "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" +
                                         std::string(reinterpret_cast<const char*>(rgbe.data()), rgbe.size()));
    const FloatImage image = readHdr(at("x.hdr"));
    EXPECT_EQ(image.width, 2U);
    EXPECT_EQ(image.height, 1U);
    EXPECT_EQ(image.channels, (std::vector<std::string>{"R", "G", "B"}));
    EXPECT_EQ(image.data, (std::vector<float>{1, 0.5F, 0, 8, 8, 8}));
}

TEST_F(ImageFile, AnythingElseIsNotARadianceFile) {
    writePng(at("x.png"), gradient(4, 4, 3));
    EXPECT_EQ(messageOf([&] { readHdr(at("x.png")); }), at("x.png").string() + ": is not a Radiance HDR image");
    writeFileAtomically(at("x.hdr"), "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 100 +X 100\n\x02\x02");
    EXPECT_TRUE(messageOf([&] { readHdr(at("x.hdr")); }).starts_with(at("x.hdr").string() + ": cannot be read"));
}

TEST_F(ExrFile, LayersReadBackExactlyWithTheirNamesAndChannels) {
    const std::array layers{
        ImageLayer{"", wave(19, 33, {"R", "G", "B", "A"})}, ImageLayer{"depth", wave(19, 33, {"Z"})},
        ImageLayer{"direct", wave(19, 33, {"R", "G", "B"})}, ImageLayer{"motion.next", wave(19, 33, {"X", "Y"})}};
    writeExr(at("x.exr"), layers);
    const std::vector<ImageLayer> back = readExr(at("x.exr"));
    ASSERT_EQ(back.size(), layers.size());
    for (size_t i = 0; i < layers.size(); ++i) {
        EXPECT_EQ(back[i].name, layers[i].name);
        EXPECT_EQ(back[i].pixelType, PixelType::float32);
        expectSame(back[i].image, layers[i].image);
    }
}

TEST_F(ExrFile, ChannelsOfALayerAreCalledLayerDotChannelInTheFile) {
    writeExr(at("x.exr"), std::array{ImageLayer{"direct", wave(3, 2, {"R", "G", "B"})}});
    const std::string content = readFile(at("x.exr"));
    for (const char* channel : {"direct.R", "direct.G", "direct.B"}) {
        EXPECT_NE(content.find(channel), std::string::npos);
    }
}

TEST_F(ExrFile, EveryFloatSurvives) {
    using Limits = std::numeric_limits<float>;
    FloatImage image{5, 1, {"Y"}, {Limits::max(), Limits::denorm_min(), -Limits::infinity(), -0.0F, 1e-30F}};
    writeExr(at("x.exr"), std::array{ImageLayer{"", image}});
    expectSame(readExr(at("x.exr")).at(0).image, image);
}

TEST_F(ExrFile, HalfKeepsElevenBitsAndFiniteValuesFinite) {
    const FloatImage image{4, 1, {"Y"}, {0.5F, 1.0F + 1.0F / 1024.0F, 1e9F, -1e9F}};
    writeExr(at("x.exr"), std::array{ImageLayer{"", image, PixelType::half}});
    const ImageLayer back = readExr(at("x.exr")).at(0);
    EXPECT_EQ(back.pixelType, PixelType::half);
    EXPECT_EQ(back.image.data, (std::vector<float>{0.5F, 1.0F + 1.0F / 1024.0F, 65504.0F, -65504.0F}));
}

TEST_F(ExrFile, OfOnePictureIsAlwaysTheSameBytes) {
    const std::array layers{ImageLayer{"", wave(100, 70, {"R", "G", "B"})},
                            ImageLayer{"depth", wave(100, 70, {"Z"}), PixelType::half}};
    writeExr(at("a.exr"), layers);
    writeExr(at("b.exr"), layers);
    EXPECT_EQ(readFile(at("a.exr")), readFile(at("b.exr")));
}

TEST_F(ExrFile, ThatDoesNotFitOnTheDiskLeavesTheOldOneWhole) {
    writeExr(at("x.exr"), std::array{ImageLayer{"", wave(2, 2, {"Y"})}});
    const std::string old = readFile(at("x.exr"));
    const FileSizeLimit limit(1000);
    EXPECT_EQ(messageOf([&] {
                  writeExr(at("x.exr"), std::array{ImageLayer{"", wave(100, 100, {"Y"})}});
              }),
              at("x.exr").string() + ": cannot be written: File too large");
    EXPECT_EQ(readFile(at("x.exr")), old);
    EXPECT_EQ(fileCount(), 1U);
}

TEST_F(ExrFile, WithoutLayersOrWithLayersThatDoNotFitTogetherIsABug) {
    EXPECT_THROW(writeExr(at("x.exr"), {}), std::logic_error);
    EXPECT_THROW(
        writeExr(at("x.exr"), std::array{ImageLayer{"", wave(2, 2, {"Y"})}, ImageLayer{"b", wave(2, 3, {"Y"})}}),
        std::logic_error);
    EXPECT_THROW(
        writeExr(at("x.exr"), std::array{ImageLayer{"a", wave(2, 2, {"Y"})}, ImageLayer{"a", wave(2, 2, {"Y"})}}),
        std::logic_error);
    EXPECT_EQ(fileCount(), 0U);
}

TEST_F(ExrFile, CutOffAnywhereIsAnError) {
    writeExr(at("x.exr"), std::array{ImageLayer{"direct", wave(64, 64, {"R", "G", "B"})}});
    const std::string whole = readFile(at("x.exr"));
    for (size_t length = 0; length < whole.size(); length += length < 500 ? 13 : 997) {
        writeFileAtomically(at("x.exr"), whole.substr(0, length));
        const std::string message = messageOf([&] { readExr(at("x.exr")); });
        EXPECT_TRUE(message.starts_with(at("x.exr").string() + ": cannot be read as EXR: "))
            << length << ' ' << message;
        EXPECT_EQ(message.find('\n'), std::string::npos);
    }
}

TEST_F(ExrFile, WithAnyByteOfItsHeaderDamagedIsReadOrIsAnError) {
    writeExr(at("x.exr"), std::array{ImageLayer{"direct", wave(16, 16, {"R", "G"})}});
    const std::string whole = readFile(at("x.exr"));
    for (size_t i = 0; i < 400; ++i) {
        std::string damaged = whole;
        damaged[i] = static_cast<char>(~damaged[i]);
        writeFileAtomically(at("x.exr"), damaged);
        messageOf([&] { readExr(at("x.exr")); });  // any other exception, or a crash, fails the test
    }
}

TEST_F(Files, AnImageIsWholeOnlyWithItsEnd) {
    const fs::path png = at("a.png");
    const fs::path exr = at("a.exr");
    EXPECT_FALSE(isWholeImage(png));
    writePng(png, {40, 40, 3, std::vector<uint8_t>(4800, 10)});
    writeExr(exr, std::vector<ImageLayer>{{"", {40, 40, {"R", "G"}, std::vector<float>(3200, 0.5F)}}});
    for (const std::filesystem::path& file : {png, exr}) {
        EXPECT_TRUE(isWholeImage(file)) << file;
        for (uint64_t size = std::filesystem::file_size(file); size > 0;) {
            size = size > 40 ? size - 40 : 0;
            std::filesystem::resize_file(file, size);
            EXPECT_FALSE(isWholeImage(file)) << file << " of " << size << " bytes";
        }
    }
    EXPECT_FALSE(isWholeImage(at("")));
}

}  // namespace
}  // namespace reflet::image_file_test
