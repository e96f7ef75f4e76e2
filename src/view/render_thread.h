// Renders the open scene on a separate thread and device, so that the window stays responsive during slow frames.
#pragma once

#include "device/device.h"
#include "view/clock.h"
#include "view/effort.h"
#include "view/session.h"
#include "view/shader_watch.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace reflet {

/// The window's request to the render thread.
struct Wanted {
    uint64_t scene = 0;  ///< number of the scene; nothing is rendered if another scene is open
    ViewerState state;
    uvec2 size{0};                     ///< size of the image; 0: none is needed
    bool moving = false;               ///< the view or the settings are changing: speed matters more than quality
    bool values = false;               ///< RenderedImage::values are needed
    uint32_t steps = 0;                ///< total number of single frames requested, rendered even while paused
    std::optional<ViewerState> right;  ///< state of another image of the same scene, for comparison
};

class RenderThread {
public:
    /// Objects of the render thread, for jobs.
    struct Work {
        gpu::Device& device;
        std::unique_ptr<Session>& live;                             ///< null before the first scene
        std::function<uint64_t(std::unique_ptr<Session>)> replace;  ///< opens another scene; returns its number
    };
    /// Remaining work of a job, to run on the window's thread once the job is done.
    using Finish = std::function<void()>;

    /// State published by the render thread.
    struct State {
        std::shared_ptr<const RenderedImage> live;
        std::shared_ptr<const RenderedImage> right;
        Effort effort;                      ///< effort of the last live frame
        uint64_t scene = 0;                 ///< scene number of `live`
        uint64_t deviceMemory = 0;          ///< bytes
        uint32_t compiling = 0;             ///< shaders that the frame waits for
        std::string shaderProblem;          ///< why an edited shader does not compile; empty: none
        std::vector<std::string> reloaded;  ///< shaders replaced by the last reload
        uint32_t reloads = 0;               ///< number of reloads
    };

    /// Opens the device, and blocks until it is open. Throws Error.
    RenderThread(const gpu::DeviceOptions& options, const std::string& shaders);
    /// As endsBy(), but without a time limit.
    ~RenderThread();
    RenderThread(const RenderThread&) = delete;
    RenderThread& operator=(const RenderThread&) = delete;

    /// Replaces the previous request. Stops a frame that is no longer wanted, unless the image is moving.
    void want(Wanted wanted);
    /// Whether a job that has not started when the thread ends is dropped or completed.
    enum class AtEnd : uint8_t { drop, complete };
    /// Runs the job between two frames. Then the window is woken, and `takeFinished` returns the job's result, or a
    /// function that rethrows its exception. name: description of the job, for busyWith().
    void post(std::string name, AtEnd atEnd, std::function<Finish(Work&)> job);
    std::vector<Finish> takeFinished();
    /// Name of the job that runs or waits; empty: none.
    [[nodiscard]] std::string busyWith() const;

    /// Stops the frame, completes jobs that must not be lost, and closes the device. Returns whether all this was done
    /// by `end`: a pass that the device has begun cannot be stopped, and may take minutes. If not, the object must not
    /// be destroyed, and unfinished() is the number of such jobs that are lost if the process ends.
    [[nodiscard]] bool endsBy(Clock::time_point end);
    [[nodiscard]] size_t unfinished() const;

    [[nodiscard]] State state() const;
    /// Whether there is nothing left to do: the image has converged, and no job waits.
    [[nodiscard]] bool rests() const;
    /// Version number of state(); changes whenever it does.
    [[nodiscard]] uint64_t published() const { return published_; }

private:
    struct Job {
        std::string name;
        AtEnd atEnd = AtEnd::drop;
        std::function<Finish(Work&)> work;
    };

    void end();
    void run(const gpu::DeviceOptions& options, const std::string& shaders, std::promise<void>& opened);
    void loop(gpu::Device& device, ShaderWatch& shaders);
    void announce(std::unique_lock<std::mutex>& lock);
    void renderWanted(gpu::Device& device, std::unique_lock<std::mutex>& lock);
    void watchShaders(gpu::Device& device, ShaderWatch& shaders);
    void runJob(const Job& job, Work& work);
    /// Renders a frame of one of the images, if one is wanted. Returns whether there was anything to do.
    bool renderNext(gpu::Device& device, const Wanted& wanted);
    bool renderLive(const Wanted& wanted);
    bool renderRight(gpu::Device& device, const Wanted& wanted);
    void publishFailure(const std::string& why);
    void publish(const std::function<void(State&)>& change);
    /// Seconds until the frame rate limit allows a frame.
    [[nodiscard]] double timeToFrame(const Wanted& wanted) const;

    // Shared by the window and the render thread, guarded by the mutex.
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Job> jobs_;  ///< the first one may be running
    std::vector<Finish> finished_;
    std::optional<Wanted> wanted_;
    uint64_t version_ = 0;  ///< version number of wanted_
    uint64_t settled_ = 0;  ///< version for which nothing is left to render
    bool ended_ = false;
    State state_;

    std::atomic<bool> ends_ = false;
    std::atomic<bool> stops_ = false;  ///< the frame that is rendered now is not wanted any more
    std::atomic<uint64_t> published_ = 0;

    // Used only by the render thread.
    std::unique_ptr<Session> live_;
    std::unique_ptr<Session> right_;
    uint64_t scene_ = 0;  ///< number of the open scene, from 1
    EffortControl effort_;
    uint32_t steps_ = 0;  ///< number of single frames rendered
    bool rightTurn_ = false;
    struct Displayed {
        bool falseColor = false;
        vec2 range{0.0F};

        bool operator==(const Displayed&) const = default;
    };
    Displayed displayed_;
    Clock::time_point lastFrame_;
    Clock::time_point lastWatch_;

    std::thread thread_;
};

}  // namespace reflet
