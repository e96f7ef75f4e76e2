// Makes films of frames: WebP itself, the others by ffmpeg.
#include "job/film.h"

#include "base/error.h"
#include "base/image_file.h"
#include "base/progress.h"
#include "job/scene_options.h"
#include "job/webp_animation.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <system_error>

namespace reflet {

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

constexpr std::array endings{".webp", ".mp4", ".webm"};

std::string endingOf(const fs::path& file) {
    return file.extension().string();
}

bool isInstalled(const std::string& program) {
    const char* path = std::getenv("PATH");
    std::string folders = path == nullptr ? "" : path;
    for (size_t begin = 0; begin <= folders.size();) {
        const size_t end = std::min(folders.find(':', begin), folders.size());
        const fs::path file = fs::path(folders.substr(begin, end - begin)) / program;
        if (end > begin && access(file.c_str(), X_OK) == 0) {
            return true;
        }
        begin = end + 1;
    }
    return false;
}

// Runs a program of PATH and waits for it. Its messages go to standard error.
int runProgram(const Words& words) {
    std::vector<char*> arguments;
    for (const std::string& word : words) {
        arguments.push_back(const_cast<char*>(word.c_str()));  // which posix_spawn does not change
    }
    arguments.push_back(nullptr);
    pid_t process = 0;
    if (const int error = posix_spawnp(&process, arguments[0], nullptr, nullptr, arguments.data(), environ)) {
        fail("{} cannot be started: {}", words.front(), std::generic_category().message(error));
    }
    int status = 0;
    while (waitpid(process, &status, 0) < 0) {
        if (errno != EINTR) {
            fail("{} cannot be waited for: {}", words.front(), std::generic_category().message(errno));
        }
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

// ffmpeg's pattern of the frames, whose own % must be doubled.
std::string ffmpegPattern(const FrameNames& frames) {
    std::string pattern;
    size_t digits = 0;
    for (const char c : frames.pattern()) {
        digits += c == '#' ? 1 : 0;
        pattern += c == '%' ? "%%" : c == '#' ? "" : std::string(1, c);
    }
    return pattern.insert(pattern.rfind(".png"), fmt::format("%0{}d", digits));
}

// Colours as displays show them: full range of sRGB to the limited range of BT.709. Subsampled colours need even sides.
constexpr const char* toVideo =
    "crop=trunc(iw/2)*2:trunc(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd,format=yuv420p";

Words codecOf(const std::string& ending) {
    if (ending == ".mp4") {
        return {"-c:v", "libx264", "-crf", "16", "-preset", "slow", "-movflags", "+faststart", "-f", "mp4"};
    }
    return {"-c:v", "libvpx-vp9", "-crf", "20", "-b:v", "0", "-row-mt", "1", "-f", "webm"};
}

void writeByFfmpeg(const std::string& film, const FrameNames& frames, double fps, uint32_t first, uint32_t count) {
    const fs::path made = frames.file(first).parent_path() / ("film" + endingOf(film));
    Words words{"ffmpeg", "-nostdin", "-loglevel", "error", "-y", "-framerate", fmt::format("{}", fps)};
    words.insert(words.end(), {"-start_number", fmt::format("{}", first), "-i", ffmpegPattern(frames)});
    words.insert(words.end(), {"-frames:v", fmt::format("{}", count), "-vf", toVideo, "-colorspace", "bt709"});
    words.insert(words.end(), {"-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv"});
    std::ranges::copy(codecOf(endingOf(film)), std::back_inserter(words));
    words.push_back(made.string());
    if (const int status = runProgram(words); status != 0) {
        fail("{}: ffmpeg ended with status {}; the frames are in {}", film, status, made.parent_path().string());
    }
    fs::rename(made, film);
}

void writeWebp(const std::string& film, const FrameNames& frames, double fps, uint32_t first, uint32_t count) {
    const Bitmap start = readBitmap(frames.file(first));
    WebpAnimation animation(start.width, start.height, fps);
    Progress progress("encoding frame", count);
    for (uint32_t i = 0; i < count; ++i) {
        animation.add(readBitmap(frames.file(first + i)));
        progress.advance();
    }
    animation.write(film);
}

void removeFrames(const FrameNames& frames) {
    for (const fs::path& file : frames.existing()) {
        fs::remove(file);
    }
    fs::remove(frames.record());
    std::error_code ignored;  // somebody put something else there
    fs::remove(frames.record().parent_path(), ignored);
}

void checkFilm(const std::string& file, uint32_t width, uint32_t height) {
    const std::string ending = endingOf(file);
    if (FrameNames::isPattern(file)) {
        failUsage("-o {}: a film is one file: leave the # away, or write .png files", file);
    }
    if (ending == ".webp" && (width > WebpAnimation::largestSide || height > WebpAnimation::largestSide)) {
        failUsage("-o {}: WebP can have up to {} pixels a side", file, WebpAnimation::largestSide);
    }
    if (ending != ".webp" && !isInstalled("ffmpeg")) {
        failUsage(
            "-o {}: {} films need ffmpeg, which is not in PATH: install it (Debian: apt install ffmpeg), or write a "
            ".webp film or frames, name_####.png",
            file, ending);
    }
    if (ending != ".webp" && (width < 2 || height < 2)) {
        failUsage("-o {}: a film of this format needs at least 2 pixels a side", file);
    }
}

}  // namespace

bool isFilm(const std::string& output) {
    return std::ranges::find(endings, endingOf(output)) != endings.end();
}

Films::Films(std::vector<std::string>& outputs, uint32_t width, uint32_t height) {
    for (std::string& output : outputs) {
        if (!isFilm(output)) {
            continue;
        }
        checkFilm(output, width, height);
        const fs::path folder = output + ".frames";
        std::error_code error;
        fs::create_directory(folder, error);
        if (error) {
            fail("{}: the folder for the frames cannot be made: {}", folder.string(), error.message());
        }
        const std::string pattern = (folder / "frame_######.png").string();
        films_.push_back({output, FrameNames(pattern)});
        output = pattern;
    }
}

Films::~Films() {
    for (const Film& film : films_) {
        std::error_code ignored;
        fs::remove(film.frames.record().parent_path(), ignored);  // fails where there are frames
    }
}

std::vector<std::string> Films::names() const {
    std::vector<std::string> names;
    std::ranges::transform(films_, std::back_inserter(names), &Film::file);
    return names;
}

bool Films::hasFrames(const std::string& output) const {
    return std::ranges::any_of(films_, [&](const Film& film) { return film.frames.pattern() == output; });
}

std::vector<std::string> Films::write(double fps, uint32_t first, uint32_t count) const {
    std::vector<std::string> written;
    for (const auto& [file, frames] : films_) {
        uint32_t missing = 0;
        for (uint32_t i = 0; i < count; ++i) {
            missing += isWholeImage(frames.file(first + i)) ? 0 : 1;
        }
        if (missing > 0) {
            printNote(
                fmt::format("{}: {} of {} frames are missing, of other shares: run the last share again once they "
                            "are there",
                            file, missing, count));
            continue;
        }
        (endingOf(file) == ".webp" ? writeWebp : writeByFfmpeg)(file, frames, fps, first, count);
        removeFrames(frames);
        written.push_back(file);
    }
    return written;
}

}  // namespace reflet
