// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/session.h"
#include "engine/core/jobs.h"
#include "engine/core/parallel.h"

#include <QElapsedTimer>
#include <QHash>
#include <QObject>
#include <QString>
#include <QTimer>

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace episcope {

class Frame;
class Messages;

/// Jobs of one lane run one after the other; lanes run in parallel. Opening a light field or
/// project ends other jobs of that lane only.
enum class Lane {
  Open,     ///< Light fields and projects.
  Load,     ///< Parts of a light field: results, meshes, masks, labels.
  Capture,  ///< Making light fields from photographs.
  Estimate,
  Label,
  Export,
  List,
  Count
};

/// All background jobs that a user sees, in all lanes: start, progress, cancellation, end and
/// failure, with unique ids.
class Jobs : public QObject {
  Q_OBJECT

 public:
  explicit Jobs(QObject* parent = nullptr);
  ~Jobs() override;

  /// Runs `work(progress) -> T` in the background. Calls `done(value)` on success, and `ended`
  /// afterwards in every case. Reports failures by `failed`.
  template <class T>
  quint64 start(Lane lane, const QString& title, std::function<T(const Progress&)> work,
                std::function<void(T)> done, std::function<void()> ended = nullptr) {
    const quint64 id = add(title, lane);
    attach(id,
           runner(lane).start<T>(
               [work = std::move(work)](const Progress& progress) {
                 lower_thread_priority();
                 return work(progress);
               },
               [this, id, done = std::move(done), ended = std::move(ended)](Outcome<T> outcome) {
                 setExpendable(id);  // there is nothing left to lose
                 if (outcome.value) {
                   emit failureIsOver(failures_.take(jobs_[id].title));
                   done(std::move(*outcome.value));
                 }
                 finish(id, outcome.failure);
                 if (ended) ended();
               },
               [this, id](const ProgressState& state) { report(id, state); }));
    return id;
  }

  /// Shows work that runs elsewhere as a job until `release`; `cancel` must release it.
  quint64 adopt(const QString& title, std::function<void()> cancel);
  void tell(quint64 id, const ProgressState& state) { report(id, state); }
  /// Ignored for an unknown id.
  void release(quint64 id) {
    if (jobs_.erase(id) > 0) emit removed(id);
  }

  /// A waiting or running job.
  struct Running {
    quint64 id = 0;
    QString title;
    double seconds = 0;   ///< Since its first progress.
    double fraction = 0;  ///< Progress, in [0, 1].
    bool is_cancelling = false;
    bool is_expendable = false;  ///< It may end without a question.
    std::uint64_t scene = 0;     ///< 0: of no light field.
  };

  /// Marks a job that can end early with a partial result.
  void setIterative(quint64 id) { emit endsEarly(id); }
  /// Assigns a job to a light field (OpenScene::id).
  void setScene(quint64 id, std::uint64_t scene) { jobs_[id].scene = scene; }
  /// Marks a job that may end without a question: nobody asked for it.
  void setExpendable(quint64 id) { jobs_[id].is_expendable = true; }
  /// Ignored for an unknown id.
  void cancel(quint64 id);
  void cancelLane(Lane lane);
  /// Asks a job for its best result so far (Progress::finish_requested); not all jobs have one.
  void finishEarly(quint64 id);
  /// None for an unknown id.
  [[nodiscard]] std::optional<Running> find(quint64 id) const;
  /// Latest job of a light field, or of no light field.
  [[nodiscard]] std::optional<Running> newest(std::uint64_t scene) const;
  /// All of a lane, the oldest first.
  [[nodiscard]] std::vector<Running> running(Lane lane) const;
  [[nodiscard]] int count() const { return static_cast<int>(jobs_.size()); }
  [[nodiscard]] int count(Lane lane) const { return static_cast<int>(running(lane).size()); }

 signals:
  void added(quint64 id, const QString& title);
  void endsEarly(quint64 id);
  void progressed(quint64 id, double fraction, const QString& viewer_area);
  void cancelling(quint64 id);
  void finishing(quint64 id);
  void removed(quint64 id);
  /// A job failed; `sentence` is for the user.
  void failed(const QString& sentence, quint64 id);
  /// What failed with this sentence has succeeded. Empty: nothing had failed.
  void failureIsOver(const QString& sentence);

 private:
  struct Job {
    std::optional<Lane> lane;  // none: it runs elsewhere
    JobId runner_id = 0;
    QString title;
    std::optional<ProgressState> news{};  // not yet told
    std::uint64_t scene = 0;
    QElapsedTimer clock{};
    double fraction = 0;
    bool is_cancelling = false;
    bool is_expendable = false;
    std::function<void()> cancel{};  // of one that runs elsewhere
  };
  [[nodiscard]] JobRunner& runner(Lane lane) { return *runners_[static_cast<std::size_t>(lane)]; }
  quint64 add(const QString& title, std::optional<Lane> lane);
  void attach(quint64 id, JobId runner_id) { jobs_[id].runner_id = runner_id; }
  void report(quint64 id, const ProgressState& state);
  void tellProgress();
  void finish(quint64 id, const std::exception_ptr& failure);

  std::map<quint64, Job> jobs_;
  quint64 last_id_ = 0;
  QHash<QString, QString> failures_;  // sentences by titles
  QTimer progress_;                   // Runs for a while after progress was told.
  std::array<std::unique_ptr<JobRunner>, static_cast<std::size_t>(Lane::Count)> runners_;
};

/// A quick background computation of which only the latest matters: a new start drops the previous
/// one.
class LatestJob {
 public:
  /// `context` must outlive this.
  explicit LatestJob(QObject* context);

  /// Calls `done(value)` unless the job was dropped, cancelled or failed.
  template <class T>
  void start(std::function<T(const Progress&)> work, std::function<void(T)> done) {
    drop();
    runner_.start<T>(
        [work = std::move(work)](const Progress& progress) {
          lower_thread_priority();
          return work(progress);
        },
        [this, number = number_, done = std::move(done)](Outcome<T> outcome) {
          if (number == number_ && outcome.value) done(std::move(*outcome.value));
        });
  }
  void drop() {
    ++number_;
    runner_.cancel_all();
  }

 private:
  std::uint64_t number_ = 0;
  JobRunner runner_;
};

/// Ends jobs for the user, by the cancel key or by buttons. Asks before ending a long-running job;
/// a second request while the question is shown ends it.
class JobCancel : public QObject {
  Q_OBJECT

 public:
  JobCancel(const Session& session, Jobs& jobs, Messages& messages, QObject* parent);

  /// Ends the latest job of the shown light field, or of no light field. Returns whether there was
  /// one.
  bool cancelNewest();
  /// Ends these jobs, or asks first if one has run long.
  void cancel(const std::vector<quint64>& ids);
  /// Jobs that ran for less time end without a question: 10 s by default.
  void setWorthAsking(double seconds) { worth_asking_s_ = seconds; }

 private:
  [[nodiscard]] std::optional<Jobs::Running> longestOf(const std::vector<quint64>& ids) const;
  void ask(const std::vector<quint64>& ids, const Jobs::Running& longest);
  void end(const std::vector<quint64>& ids, const Jobs::Running& longest);

  const Session& session_;
  Jobs& jobs_;
  Messages& messages_;
  double worth_asking_s_ = 10;
  quint64 asked_ = 0;  // job that was asked for last,
  QString question_;   // by this sentence
};

/// Title of a job: "EPI_S · still_life", since several light fields may be open.
[[nodiscard]] inline QString job_title(const QString& what, const OpenScene& scene) {
  return QStringLiteral("%1 · %2").arg(what, QString::fromStdString(scene.name));
}

/// Title of a job on the shown light field.
[[nodiscard]] inline QString job_title(const QString& what, const Session& session) {
  const OpenScene* scene = session.find_scene(session.generation());
  return scene == nullptr ? what : job_title(what, *scene);
}

/// Shows the jobs with their buttons below the tabs, and reports failures to the user.
void show_jobs(Jobs& jobs, JobCancel& cancel, Frame& frame, Messages& messages);

/// Names options of the command line as “Conventions…” does: “Views to keep: all” for "--crop all".
[[nodiscard]] QString with_conventions(QString sentence);

/// Posts closures from any thread to the event loop of `context`'s thread; drops them when
/// `context` is destroyed. Posters must have ended before that.
[[nodiscard]] JobRunner::Post queued_post(QObject* context);

}  // namespace episcope
