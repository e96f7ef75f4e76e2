// Finds a process's share: named on the command line, or in the environment that a scheduler gave it.
#include "job/share.h"

#include "base/error.h"

#include <charconv>
#include <cstdlib>
#include <optional>
#include <string_view>

namespace reflet {

namespace {

std::optional<uint32_t> number(std::string_view text) {
    uint32_t value = 0;
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && rest == end ? std::optional(value) : std::nullopt;
}

std::optional<uint32_t> variable(const EnvironmentVariable& environment, const char* name) {
    const char* text = environment(name);
    if (text == nullptr || *text == '\0') {
        return std::nullopt;
    }
    const std::optional<uint32_t> value = number(text);
    if (!value) {
        failUsage("--share auto: the environment's {} must be a whole number, is '{}'", name, text);
    }
    return value;
}

uint32_t needed(const EnvironmentVariable& environment, const char* name) {
    const std::optional<uint32_t> value = variable(environment, name);
    if (!value) {
        failUsage("--share auto: the environment has no {}; name the share: --share K/N", name);
    }
    return *value;
}

/// What the environment says. `count` 0: unknown.
struct Found {
    std::string_view source;
    uint64_t index = 0;
    uint64_t count = 0;
};

// Tasks of an array, and the tasks that srun starts in each of them. A batch script that starts the program without
// srun is one task, however many the job has room for: so the step's variables count, and not the job's.
std::optional<Found> fromSlurm(const EnvironmentVariable& environment) {
    Found found{"Slurm", 0, 1};
    const std::optional<uint32_t> id = variable(environment, "SLURM_ARRAY_TASK_ID");
    if (id) {
        const uint32_t first = needed(environment, "SLURM_ARRAY_TASK_MIN");
        const uint32_t last = needed(environment, "SLURM_ARRAY_TASK_MAX");
        const uint32_t step = variable(environment, "SLURM_ARRAY_TASK_STEP").value_or(1);
        found.count = needed(environment, "SLURM_ARRAY_TASK_COUNT");
        if (step == 0 || *id < first || *id > last || (*id - first) % step != 0 ||
            found.count != (last - first) / step + 1) {
            failUsage(
                "--share auto: task {} of the job array: {} tasks from {} to {} are not all numbers of a range; submit "
                "--array=0-{}, or name the share: --share K/N",
                *id, found.count, first, last, found.count - 1);
        }
        found.index = (*id - first) / step;
    }
    const uint32_t tasks = variable(environment, "SLURM_STEP_NUM_TASKS").value_or(1);
    if (tasks > 1) {
        const uint32_t task = needed(environment, "SLURM_PROCID");
        found.index = found.index * tasks + task;
        found.count *= tasks;
    }
    return id || tasks > 1 ? std::optional(found) : std::nullopt;
}

// Counted from 1, and without their number.
std::optional<Found> fromOthers(const EnvironmentVariable& environment) {
    constexpr std::pair<const char*, const char*> others[] = {
        {"PBS_ARRAY_INDEX", "PBS"}, {"PBS_ARRAYID", "PBS"}, {"PARALLEL_SEQ", "GNU parallel"}};
    for (const auto& [name, source] : others) {
        if (const std::optional<uint32_t> index = variable(environment, name)) {
            if (*index == 0) {
                failUsage("--share auto: {} is 0; number the array from 1, as in qsub -J 1-16", name);
            }
            return Found{source, *index - 1, 0};
        }
    }
    return std::nullopt;
}

Share automatic(uint32_t stated, const EnvironmentVariable& environment) {
    const std::optional<Found> slurm = fromSlurm(environment);
    const std::optional<Found> other = fromOthers(environment);
    if (slurm && other) {
        failUsage("--share auto: the environment is of {} and of {}; name the share: --share K/N", slurm->source,
                  other->source);
    }
    if (!slurm && !other) {
        failUsage(
            "--share auto: the environment has no job array (SLURM_ARRAY_TASK_ID, PBS_ARRAY_INDEX or PARALLEL_SEQ); "
            "name the share, --share K/N, or leave it out to render all");
    }
    const Found& found = slurm ? *slurm : *other;
    if (found.count == 0 && stated == 0) {
        failUsage("--share auto: {} does not tell how many tasks there are; add their number, as in --share auto/16",
                  found.source);
    }
    if (found.count != 0 && stated != 0 && found.count != stated) {
        failUsage("--share auto/{}: {} has {} tasks; leave the number out", stated, found.source, found.count);
    }
    const uint64_t count = found.count != 0 ? found.count : stated;
    if (found.index >= count || count > UINT32_MAX) {
        failUsage("--share auto: {}'s task {} is not one of {}", found.source, found.index + 1, count);
    }
    return {static_cast<uint32_t>(found.index), static_cast<uint32_t>(count)};
}

}  // namespace

Share parseShare(const std::string& text) {
    return parseShare(text, [](const char* name) -> const char* { return std::getenv(name); });
}

Share parseShare(const std::string& text, const EnvironmentVariable& environment) {
    if (text.empty()) {
        return {};
    }
    const size_t slash = text.find('/');
    const std::string_view first = std::string_view(text).substr(0, slash);
    const bool alone = slash == std::string::npos;
    const uint32_t count = alone ? 0 : number(std::string_view(text).substr(slash + 1)).value_or(0);
    if (first == "auto" && (alone || count > 0)) {
        return automatic(count, environment);
    }
    const uint32_t position = number(first).value_or(0);
    if (position < 1 || position > count) {
        failUsage("--share must be K/N with K from 1 to N, as in 3/16, or auto, is '{}'", text);
    }
    return {position - 1, count};
}

}  // namespace reflet
