// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/jobs.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

namespace episcope {
namespace {

// What the owner may ask of a job.
struct Requests {
  std::stop_source stop;
  std::stop_source finish;
};

struct Job {
  JobId id = 0;
  Requests requests;
  std::function<void(const Progress&)> run;
  std::function<void()> finish;
  JobRunner::OnProgress on_progress;
};

// The newest state of a job on its way to the owner. No lock: the owner would wait for a worker of
// lower priority that was interrupted while it held it.
class Mailbox {
 public:
  Mailbox() = default;
  ~Mailbox() { delete newest_.load(); }
  Mailbox(const Mailbox&) = delete;
  Mailbox& operator=(const Mailbox&) = delete;

  /// Whether it was empty: then somebody must be sent to empty it.
  [[nodiscard]] bool put(const ProgressState& state) {
    const std::unique_ptr<ProgressState> before(
        newest_.exchange(std::make_unique<ProgressState>(state).release()));
    return before == nullptr;
  }
  /// Precondition: `put` said so, and nobody else was sent.
  [[nodiscard]] ProgressState take() {
    const std::unique_ptr<ProgressState> newest(newest_.exchange(nullptr));
    return std::move(*newest);
  }

 private:
  std::atomic<ProgressState*> newest_{nullptr};
};

}  // namespace

struct JobRunner::State {
  Post post;
  mutable std::mutex mutex;
  std::condition_variable_any wake;
  std::deque<std::shared_ptr<Job>> queue;
  std::map<JobId, Requests> alive;
  JobId last_id = 0;
  std::atomic<bool> closed{false};
  std::jthread thread;

  std::shared_ptr<Job> take_from_queue(JobId id);
  void work(const std::stop_token& end);
  void run(Job& job);
};

std::shared_ptr<Job> JobRunner::State::take_from_queue(JobId id) {
  const auto found = std::find_if(queue.begin(), queue.end(),
                                  [id](const std::shared_ptr<Job>& job) { return job->id == id; });
  if (found == queue.end()) return nullptr;
  std::shared_ptr<Job> job = *found;
  queue.erase(found);
  return job;
}

void JobRunner::State::work(const std::stop_token& end) {
  while (true) {
    std::shared_ptr<Job> job;
    {
      std::unique_lock lock(mutex);
      if (!wake.wait(lock, end, [this] { return !queue.empty(); })) return;
      job = queue.front();
      queue.pop_front();
    }
    run(*job);
  }
}

void JobRunner::State::run(Job& job) {
  Progress::Listener listener;
  if (job.on_progress) {
    auto mailbox = std::make_shared<Mailbox>();
    listener = [this, mailbox, handler = job.on_progress](const ProgressState& state) {
      if (closed || !mailbox->put(state)) return;
      post([mailbox, handler] { handler(mailbox->take()); });
    };
  }
  const Progress progress(job.requests.stop.get_token(), job.requests.finish.get_token(),
                          std::move(listener));
  if (!progress.stop_requested()) job.run(progress);
  {
    const std::scoped_lock lock(mutex);
    alive.erase(job.id);
  }
  if (!closed) post(std::move(job.finish));
}

JobRunner::JobRunner(Post post) : state_(std::make_shared<State>()) {
  state_->post = std::move(post);
  state_->thread =
      std::jthread([state = state_.get()](const std::stop_token& end) { state->work(end); });
}

JobRunner::~JobRunner() {
  state_->closed = true;
  {
    const std::scoped_lock lock(state_->mutex);
    for (auto& [id, requests] : state_->alive) requests.stop.request_stop();
    state_->queue.clear();
  }
  state_->thread.request_stop();
  state_->thread.join();
}

JobId JobRunner::enqueue(std::function<void(const Progress&)> run, std::function<void()> finish,
                         OnProgress on_progress) {
  auto job = std::make_shared<Job>();
  job->run = std::move(run);
  job->finish = std::move(finish);
  job->on_progress = std::move(on_progress);
  {
    const std::scoped_lock lock(state_->mutex);
    job->id = ++state_->last_id;
    state_->alive.emplace(job->id, job->requests);
    state_->queue.push_back(job);
  }
  state_->wake.notify_one();
  return job->id;
}

void JobRunner::cancel(JobId id) {
  std::shared_ptr<Job> unstarted;
  {
    const std::scoped_lock lock(state_->mutex);
    const auto found = state_->alive.find(id);
    if (found == state_->alive.end()) return;
    found->second.stop.request_stop();
    unstarted = state_->take_from_queue(id);
    if (unstarted) state_->alive.erase(found);
  }
  // It need not wait for its turn to say so.
  if (unstarted) state_->post(std::move(unstarted->finish));
}

void JobRunner::finish(JobId id) {
  const std::scoped_lock lock(state_->mutex);
  const auto found = state_->alive.find(id);
  if (found != state_->alive.end()) found->second.finish.request_stop();
}

void JobRunner::cancel_all() {
  std::vector<JobId> ids;
  {
    const std::scoped_lock lock(state_->mutex);
    for (const auto& [id, requests] : state_->alive) ids.push_back(id);
  }
  for (const JobId id : ids) cancel(id);
}

int JobRunner::pending() const {
  const std::scoped_lock lock(state_->mutex);
  return static_cast<int>(state_->alive.size());
}

}  // namespace episcope
