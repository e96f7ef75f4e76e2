// The command line's options for sequences.
#include "cli/sequence_arguments.h"
#include "cli/in_range.h"

#include "base/error.h"
#include "job/film.h"
#include "job/sequence_names.h"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace reflet {

std::vector<const CLI::Option*> addSequenceOptions(CLI::App& command, SequenceOptions& o, bool history) {
    std::vector<const CLI::Option*> all;
    all.push_back(command.add_option("--first-frame", o.firstFrame, "Sequences: frame number in the first file's name")
                      ->capture_default_str());
    all.push_back(command.add_option("--fps", o.fps, "Sequences: frames per second; the first frame is at --time")
                      ->type_name("F")
                      ->capture_default_str());
    all.push_back(command
                      .add_option("--path", o.path,
                                  "Sequences: camera path; orbit: once around its target; or a file of keyframes "
                                  "(docs/view-files.md)")
                      ->type_name("orbit|FILE.json"));
    if (history) {
        all.push_back(command
                          .add_option("--segment", o.segment,
                                      "Sequences: frames rendered consecutively, starting from an empty history; 0: "
                                      "all. Always 1 if the settings keep no history and no motion is written")
                          ->type_name("FRAMES")
                          ->capture_default_str());
        all.push_back(
            command
                .add_option("--warmup", o.warmUp,
                            "Sequences: frames rendered before each segment to fill the history, but not written")
                ->check(inRange(0U, 10000U))
                ->type_name("FRAMES")
                ->capture_default_str());
    }
    all.push_back(
        command
            .add_option("--share", o.share,
                        fmt::format("Sequences: make only every Nth {}, for N processes, as in 3/16; auto: K and N "
                                    "from the environment of a Slurm job array; auto/N: K from a PBS array or GNU "
                                    "parallel (docs/many-machines.md)",
                                    history ? "segment" : "frame"))
            ->type_name("K/N|auto|auto/N"));
    all.push_back(command.add_flag("--overwrite", o.overwrite,
                                   "Sequences: remove existing frames first, also those of other settings"));
    return all;
}

void checkSequenceOptions(const std::vector<const CLI::Option*>& options, const std::vector<std::string>& outputs) {
    if (std::ranges::any_of(outputs, FrameNames::isPattern) || std::ranges::any_of(outputs, isFilm)) {
        return;
    }
    for (const CLI::Option* option : options) {
        if (option->count() > 0) {
            failUsage(
                "{} is only for sequences: name the output with a run of #, as in -o picture_####.png, or as a film, "
                "-o film.webp",
                option->get_name());
        }
    }
}

}  // namespace reflet
