// Renders the open scene on a thread and a device of its own, so that the window answers whatever a frame costs.
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

/// What the window wants to see.
struct Wanted {
    uint64_t scene = 0;  ///< number of the scene; nothing is rendered for others
    ViewerState state;
    uvec2 size{0};        ///< of the image; 0: none is needed
    bool moving = false;  ///< the view or the settings are changing: a quick image is better than a good one
    bool values = false;  ///< RenderedImage::values are needed
    uint32_t steps = 0;   ///< single frames that were asked for in total, rendered even while paused
    std::optional<ViewerState> right;  ///< of another image of the same scene, for comparison
};

class RenderThread {
public:
    /// For the thread that renders.
    struct Work {
        gpu::Device& device;
        std::unique_ptr<Session>& live;                             ///< null before the first scene
        std::function<void()> forgetRight;                          ///< makes the other image anew
        std::function<uint64_t(std::unique_ptr<Session>)> replace;  ///< opens another scene; returns its number
    };
    /// What is left to do on the window's thread once a job is done.
    using Finish = std::function<void()>;

    /// What the thread publishes.
    struct State {
        std::shared_ptr<const RenderedImage> live;
        std::shared_ptr<const RenderedImage> right;
        Effort effort;                      ///< of the last live frame
        uint64_t scene = 0;                 ///< of `live`
        uint64_t deviceMemory = 0;          ///< bytes
        uint32_t compiling = 0;             ///< shaders that the frame waits for
        std::string shaderProblem;          ///< why an edited shader does not compile; empty: none
        std::vector<std::string> reloaded;  ///< shaders that were replaced last
        uint32_t reloads = 0;               ///< how often shaders were replaced
    };

    /// Opens the device, and blocks until it is open. Throws Error.
    RenderThread(const gpu::DeviceOptions& options, const std::string& shaders);
    /// As endsBy(), but waits for as long as it takes.
    ~RenderThread();
    RenderThread(const RenderThread&) = delete;
    RenderThread& operator=(const RenderThread&) = delete;

    /// Replaces what was wanted before. Stops a frame that is no longer wanted, unless the image is moving.
    void want(Wanted wanted);
    /// Whether a job that has not begun when the thread ends is lost.
    enum class AtEnd : uint8_t { drop, complete };
    /// Runs the job between two frames. The window is woken, and `takeFinished` returns what the job returned, or
    /// something that throws what the job threw. name: of what it does, for busyWith().
    void post(std::string name, AtEnd atEnd, std::function<Finish(Work&)> job);
    std::vector<Finish> takeFinished();
    /// Name of the job that runs or waits; empty: none.
    [[nodiscard]] std::string busyWith() const;

    /// Stops the frame, completes jobs that must not be lost, and closes the device. Returns whether all that was done
    /// by then: a pass that the device has begun cannot be stopped, and may take minutes. If not, the object must not
    /// be destroyed, and `unfinished` is the number of such jobs that are lost if the process ends.
    [[nodiscard]] bool endsBy(Clock::time_point end);
    [[nodiscard]] size_t unfinished() const;

    [[nodiscard]] State state() const;
    /// Whether there is nothing left to do: the image has converged, and no job waits.
    [[nodiscard]] bool rests() const;
    /// Counts what is published; changes whenever state() has.
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

    // Of the window and the thread, guarded by the mutex.
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Job> jobs_;  ///< the first one may be running
    std::vector<Finish> finished_;
    std::optional<Wanted> wanted_;
    uint64_t version_ = 0;  ///< of wanted_
    uint64_t settled_ = 0;  ///< version for which nothing is left to render
    bool ended_ = false;
    State state_;

    std::atomic<bool> ends_ = false;
    std::atomic<bool> stops_ = false;  ///< the frame that is rendered now is not wanted any more
    std::atomic<uint64_t> published_ = 0;

    // Of the thread.
    std::unique_ptr<Session> live_;
    std::unique_ptr<Session> right_;
    uint64_t scene_ = 0;  ///< number of the open scene, from 1
    EffortControl effort_;
    uint32_t steps_ = 0;  ///< done
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
