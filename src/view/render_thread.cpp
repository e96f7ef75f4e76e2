// The thread that renders for the window.
#include "view/render_thread.h"

#include "base/error.h"
#include "view/background.h"

#include <algorithm>
#include <utility>

namespace reflet {

namespace {

constexpr double watchEvery = 0.5;  // seconds between looks at the shader files

// Whether a frame for `a` is of no use for `b`.
bool differs(const Wanted& a, const Wanted& b) {
    return a.scene != b.scene || a.size != b.size || a.state.show != b.state.show || !(a.state.view == b.state.view) ||
           !sameSettings(a.state.settings, b.state.settings);
}

bool sameRight(const std::optional<ViewerState>& a, const std::optional<ViewerState>& b) {
    return a.has_value() == b.has_value() && (!a || sameSettings(a->settings, b->settings));
}

bool same(const Wanted& a, const Wanted& b) {
    return !differs(a, b) && a.moving == b.moving && a.values == b.values && a.steps == b.steps &&
           a.state.running == b.state.running && a.state.plays == b.state.plays &&
           a.state.falseColor == b.state.falseColor && a.state.low == b.state.low && a.state.high == b.state.high &&
           a.state.mostFrames == b.state.mostFrames && sameRight(a.right, b.right);
}

}  // namespace

RenderThread::RenderThread(const gpu::DeviceOptions& options, const std::string& shaders) {
    std::promise<void> opened;
    std::future<void> isOpen = opened.get_future();
    thread_ = std::thread([&, this] {
        run(options, shaders, opened);
        const std::scoped_lock lock(mutex_);
        ended_ = true;
        changed_.notify_all();
    });
    try {
        isOpen.get();
    } catch (...) {
        thread_.join();
        throw;
    }
}

RenderThread::~RenderThread() {
    end();
    thread_.join();
}

void RenderThread::end() {
    {
        const std::scoped_lock lock(mutex_);
        ends_ = true;
        stops_ = true;
    }
    changed_.notify_all();
}

bool RenderThread::endsBy(Clock::time_point end) {
    this->end();
    std::unique_lock lock(mutex_);
    return changed_.wait_until(lock, end, [this] { return ended_; });
}

size_t RenderThread::unfinished() const {
    const std::scoped_lock lock(mutex_);
    return static_cast<size_t>(std::ranges::count(jobs_, AtEnd::complete, &Job::atEnd));
}

void RenderThread::want(Wanted wanted) {
    {
        const std::scoped_lock lock(mutex_);
        if (wanted_ && same(*wanted_, wanted)) {
            return;
        }
        // A moving image would never be seen if each move stopped its frame.
        if (wanted_ && !wanted_->moving && (differs(*wanted_, wanted) || !sameRight(wanted_->right, wanted.right))) {
            stops_ = true;
        }
        wanted_ = std::move(wanted);
        ++version_;
    }
    changed_.notify_all();
}

void RenderThread::post(std::string name, AtEnd atEnd, std::function<Finish(Work&)> job) {
    {
        const std::scoped_lock lock(mutex_);
        jobs_.push_back({std::move(name), atEnd, std::move(job)});
    }
    changed_.notify_all();
}

std::vector<RenderThread::Finish> RenderThread::takeFinished() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(finished_, {});
}

std::string RenderThread::busyWith() const {
    const std::scoped_lock lock(mutex_);
    return jobs_.empty() ? "" : jobs_.front().name;
}

RenderThread::State RenderThread::state() const {
    const std::scoped_lock lock(mutex_);
    return state_;
}

bool RenderThread::rests() const {
    const std::scoped_lock lock(mutex_);
    return jobs_.empty() && finished_.empty() && wanted_ && settled_ == version_;
}

void RenderThread::publish(const std::function<void(State&)>& change) {
    {
        const std::scoped_lock lock(mutex_);
        change(state_);
        ++published_;
    }
    Window::wake();
}

void RenderThread::run(const gpu::DeviceOptions& options, const std::string& shaders, std::promise<void>& opened) {
    stepBack();
    std::unique_ptr<gpu::Device> device;
    std::unique_ptr<ShaderWatch> watch;
    gpu::DeviceOptions own = options;
    own.onCompile = [this](uint32_t count) { publish([&](State& state) { state.compiling = count; }); };
    try {
        device = std::make_unique<gpu::Device>(own);
        watch = std::make_unique<ShaderWatch>(device->shaders(), shaders);
        opened.set_value();  // its owner may be gone from now on
    } catch (...) {
        opened.set_exception(std::current_exception());
        return;
    }
    loop(*device, *watch);
    live_.reset();
    right_.reset();
}

void RenderThread::loop(gpu::Device& device, ShaderWatch& shaders) {
    Work work{device, live_, [this](std::unique_ptr<Session> session) {
                  right_.reset();
                  live_ = std::move(session);
                  return ++scene_;
              }};
    std::unique_lock lock(mutex_);
    for (;;) {
        if (ends_) {
            std::erase_if(jobs_, [](const Job& job) { return job.atEnd == AtEnd::drop; });
        }
        if (!jobs_.empty()) {
            const Job& job = jobs_.front();  // others may be added behind it
            lock.unlock();
            runJob(job, work);
            lock.lock();
            jobs_.pop_front();
            announce(lock);
        } else if (ends_) {
            return;
        } else if (shaders.watches() && secondsSince(lastWatch_) >= watchEvery) {
            lock.unlock();
            watchShaders(device, shaders);
            lock.lock();
        } else if (!wanted_ || settled_ == version_) {
            changed_.wait_for(lock, std::chrono::duration<double>(watchEvery));
        } else {
            renderWanted(device, lock);
        }
    }
}

// Wakes the window for what has been published. lock: held.
void RenderThread::announce(std::unique_lock<std::mutex>& lock) {
    ++published_;
    lock.unlock();
    Window::wake();
    lock.lock();
}

// A frame of what is wanted, once the frame rate limit allows it. lock: held.
void RenderThread::renderWanted(gpu::Device& device, std::unique_lock<std::mutex>& lock) {
    const Wanted wanted = *wanted_;
    const uint64_t version = version_;
    stops_ = false;
    if (const double wait = timeToFrame(wanted); wait > 0.0) {
        changed_.wait_for(lock, std::chrono::duration<double>(wait));
        return;
    }
    lock.unlock();
    bool more = false;
    try {
        more = renderNext(device, wanted);
    } catch (const Error& error) {
        publishFailure(error.what());
    } catch (const std::bad_alloc&) {
        publishFailure("not enough memory for this image; a smaller window or a lower resolution needs less");
    }
    lock.lock();
    state_.deviceMemory = device.memory().used(gpu::MemoryUse::device);
    if (!more && version == version_) {
        settled_ = version;
        announce(lock);
    }
}

// Nothing is tried again before something else is wanted.
void RenderThread::publishFailure(const std::string& why) {
    live_->resetHistory();
    auto shown = std::make_shared<RenderedImage>();
    shown->problem = why;
    publish([&](State& state) {
        state.live = shown;
        state.scene = scene_;  // even if none of its frames has succeeded
        state.compiling = 0;
    });
}

void RenderThread::watchShaders(gpu::Device& device, ShaderWatch& shaders) {
    const std::string before = shaders.problem();
    const bool replaced = shaders.update([this] { return ends_.load(); });
    lastWatch_ = Clock::now();
    if (replaced) {
        device.pipelines().clear();
        right_.reset();
        if (live_) {
            live_->resetHistory();
        }
    }
    if (replaced || shaders.problem() != before) {
        publish([&](State& state) {
            state.shaderProblem = shaders.problem();
            state.reloaded = shaders.replaced();
            state.reloads += replaced ? 1 : 0;
            settled_ = replaced ? 0 : settled_;
        });
    }
}

void RenderThread::runJob(const Job& job, Work& work) {
    Finish finish;
    try {
        finish = job.work(work);
    } catch (...) {
        finish = [error = std::current_exception()] { std::rethrow_exception(error); };
    }
    const std::scoped_lock lock(mutex_);
    finished_.push_back(std::move(finish));
}

double RenderThread::timeToFrame(const Wanted& wanted) const {
    const float most = wanted.state.mostFrames;
    return most > 0.0F ? std::max(1.0 / double(most) - secondsSince(lastFrame_), 0.0) : 0.0;
}

bool RenderThread::renderNext(gpu::Device& device, const Wanted& wanted) {
    if (!live_ || wanted.scene != scene_ || wanted.size.x == 0 || wanted.size.y == 0) {
        return false;
    }
    rightTurn_ = !rightTurn_;  // both converge at the same time
    if (rightTurn_) {
        return renderRight(device, wanted) || renderLive(wanted);
    }
    return renderLive(wanted) || renderRight(device, wanted);
}

bool RenderThread::renderLive(const Wanted& wanted) {
    const Displayed display{wanted.state.falseColor, {wanted.state.low, wanted.state.high}};
    const Effort effort = wanted.moving ? effort_.choose(wanted.size) : Effort{};
    ViewerState state = wanted.state;
    uvec2 size = wanted.size;
    reduce(effort, size, state.settings);
    const bool lacksValues = wanted.values && !live_->shown().values && live_->shown().problem.empty();
    const bool paused = wanted.state.running == Running::paused;
    const bool steps = steps_ != wanted.steps;
    if (!steps &&
        (paused || (wanted.state.running == Running::onDemand && !lacksValues && !live_->wantsFrame(state, size)))) {
        if (display == displayed_ || !live_->shown().values) {
            return false;
        }
        displayed_ = display;
        live_->refreshPicture(state);
    } else {
        const bool mayStop = !wanted.moving && !steps;
        const Clock::time_point start = Clock::now();
        std::function<bool()> stop;  // none for short frames: each pass would be waited for
        if (mayStop) {
            stop = [this] { return stops_.load(std::memory_order_relaxed); };
        }
        const bool done = live_->render(state, size, wanted.values, stop);
        lastFrame_ = Clock::now();
        const double milliseconds = 1e3 * secondsSince(start);
        if (!done) {
            effort_.noteStopped(wanted.size, milliseconds);
            return true;
        }
        steps_ = wanted.steps;
        displayed_ = display;
        effort_.note(wanted.size, effort, milliseconds);
    }
    auto shown = std::make_shared<RenderedImage>(live_->shown());
    publish([&](State& published) {
        published.live = shown;
        published.effort = effort;
        published.scene = wanted.scene;
    });
    return true;
}

bool RenderThread::renderRight(gpu::Device& device, const Wanted& wanted) {
    if (!wanted.right || wanted.moving || wanted.state.running == Running::paused) {
        return false;
    }
    auto shown = std::make_shared<RenderedImage>();
    try {
        if (!right_) {
            right_ = std::make_unique<Session>(device, *live_);
        }
        if (!right_->wantsFrame(*wanted.right, wanted.size)) {
            return false;
        }
        if (!right_->render(*wanted.right, wanted.size, true, [&] { return stops_.load(std::memory_order_relaxed); })) {
            return true;
        }
        *shown = right_->shown();
    } catch (const Error& error) {
        right_.reset();
        shown->problem = error.what();
    } catch (const std::bad_alloc&) {
        right_.reset();
        shown->problem = "not enough memory for this image";
    }
    publish([&](State& state) { state.right = shown; });
    return shown->problem.empty();
}

}  // namespace reflet
