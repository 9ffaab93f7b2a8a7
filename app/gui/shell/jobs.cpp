// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/jobs.h"

#include "app/gui/shell/frame.h"
#include "engine/core/error.h"
#include "engine/io/models/open_options.h"
#include "widgets/controls/message_bar.h"
#include "widgets/controls/text.h"

#include <QCoreApplication>
#include <QMetaObject>
#include <QRegularExpression>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <utility>

namespace episcope {
namespace {

constexpr std::chrono::milliseconds kTimeBetweenProgress{100};

// Steps that the engine composes of a name or numbers.
constexpr const char* kComposedSteps[] = {
    QT_TRANSLATE_NOOP("episcope::Step", "reading %1"),
    QT_TRANSLATE_NOOP("episcope::Step", "writing %1"),
    QT_TRANSLATE_NOOP("episcope::Step", "rendering the scene %1"),
    QT_TRANSLATE_NOOP("episcope::Step", "exposing %1"),
    QT_TRANSLATE_NOOP("episcope::Step", "photographing view %1"),
    QT_TRANSLATE_NOOP("episcope::Step", "depth of view %1"),
    QT_TRANSLATE_NOOP("episcope::Step", "matching view %1"),
    QT_TRANSLATE_NOOP("episcope::Step", "finding the pattern in %1"),
    QT_TRANSLATE_NOOP("episcope::Step", "ordering, sweep %1"),
    QT_TRANSLATE_NOOP("episcope::Step", "labeling, gap %1")};

QString step_words(const std::string& step) {
  const QString english = QString::fromStdString(step);
  const QString words = schema_text(step);
  if (words != english) return words;
  for (const char* each : kComposedSteps) {
    const QString begin = QString::fromLatin1(each).chopped(2);
    if (!english.startsWith(begin)) continue;
    return QCoreApplication::translate("episcope::Step", each).arg(english.mid(begin.size()));
  }
  return words;
}

}  // namespace

Jobs::Jobs(QObject* parent) : QObject(parent) {
  for (auto& each : runners_) each = std::make_unique<JobRunner>(queued_post(this));
  progress_.setSingleShot(true);
  connect(&progress_, &QTimer::timeout, this, &Jobs::tellProgress);
}

Jobs::~Jobs() = default;

quint64 Jobs::adopt(const QString& title, std::function<void()> cancel) {
  const quint64 id = add(title, std::nullopt);
  jobs_[id].cancel = std::move(cancel);
  return id;
}

quint64 Jobs::add(const QString& title, std::optional<Lane> lane) {
  jobs_[++last_id_] = {.lane = lane, .title = title};
  emit added(last_id_, title);
  return last_id_;
}

void Jobs::report(quint64 id, const ProgressState& state) {
  const auto found = jobs_.find(id);
  if (found == jobs_.end()) return;
  Job& job = found->second;
  if (!job.clock.isValid()) job.clock.start();
  job.fraction = state.fraction;
  job.news = state;
  if (!progress_.isActive()) tellProgress();
}

// Methods report more often than anybody reads, and each report is painted.
void Jobs::tellProgress() {
  bool has_told = false;
  for (auto& [id, job] : jobs_) {
    const auto news = std::exchange(job.news, std::nullopt);
    if (!news) continue;
    emit progressed(id, news->fraction, step_words(news->step));
    has_told = true;
  }
  if (has_told) progress_.start(kTimeBetweenProgress);
}

void Jobs::finish(quint64 id, const std::exception_ptr& failure) {
  const QString title = jobs_[id].title;
  jobs_.erase(id);
  emit removed(id);
  if (!failure) return;
  const QString reason = schema_text(failure_text(failure));
  const QString named = with_conventions(reason);
  QString sentence = tr("%1 failed: %2").arg(title, named);
  if (named != reason) sentence = tr("%1. Set this in “Conventions…”.").arg(sentence);
  failures_[title] = sentence;
  emit failed(sentence, id);
}

void Jobs::cancel(quint64 id) {
  const auto found = jobs_.find(id);
  if (found == jobs_.end()) return;
  if (const auto cancel = found->second.cancel) return cancel();
  found->second.is_cancelling = true;
  runner(*found->second.lane).cancel(found->second.runner_id);
  emit cancelling(id);
}

void Jobs::finishEarly(quint64 id) {
  const auto found = jobs_.find(id);
  if (found == jobs_.end() || !found->second.lane) return;
  runner(*found->second.lane).finish(found->second.runner_id);
  emit finishing(id);
}

void Jobs::cancelLane(Lane lane) {
  for (const auto& [id, job] : jobs_) {
    if (job.lane == lane) cancel(id);
  }
}

std::optional<Jobs::Running> Jobs::find(quint64 id) const {
  const auto found = jobs_.find(id);
  if (found == jobs_.end()) return std::nullopt;
  const Job& job = found->second;
  const double seconds = job.clock.isValid() ? static_cast<double>(job.clock.elapsed()) / 1000 : 0;
  return Running{id,       job.title, seconds, job.fraction, job.is_cancelling, job.is_expendable,
                 job.scene};
}

std::optional<Jobs::Running> Jobs::newest(std::uint64_t scene) const {
  const auto found = std::find_if(jobs_.rbegin(), jobs_.rend(), [scene](const auto& each) {
    return each.second.scene == scene || each.second.scene == 0;
  });
  return found == jobs_.rend() ? std::nullopt : find(found->first);
}

std::vector<Jobs::Running> Jobs::running(Lane lane) const {
  std::vector<Running> all;
  for (const auto& [id, job] : jobs_) {
    if (job.lane == lane) all.push_back(*find(id));
  }
  return all;
}

LatestJob::LatestJob(QObject* context) : runner_(queued_post(context)) {}

JobCancel::JobCancel(const Session& session, Jobs& jobs, Messages& messages, QObject* parent)
    : QObject(parent), session_(session), jobs_(jobs), messages_(messages) {
  connect(&jobs_, &Jobs::removed, this, [this](quint64 id) {
    if (id == asked_) messages_.retract(question_);
  });
}

bool JobCancel::cancelNewest() {
  const auto job = jobs_.newest(session_.generation());
  if (job) cancel({job->id});
  return job.has_value();
}

void JobCancel::cancel(const std::vector<quint64>& ids) {
  const auto longest = longestOf(ids);
  if (!longest) return;
  const bool is_answer = asked_ == longest->id && messages_.isShown(question_);
  if (is_answer || longest->seconds < worth_asking_s_) {
    end(ids, *longest);
  } else {
    ask(ids, *longest);
  }
}

// Considers only jobs that are not being cancelled.
std::optional<Jobs::Running> JobCancel::longestOf(const std::vector<quint64>& ids) const {
  std::optional<Jobs::Running> longest;
  for (const quint64 id : ids) {
    const auto job = jobs_.find(id);
    if (!job || job->is_cancelling) continue;
    if (!longest || job->seconds > longest->seconds) longest = job;
  }
  return longest;
}

void JobCancel::ask(const std::vector<quint64>& ids, const Jobs::Running& longest) {
  asked_ = longest.id;
  question_ = tr("%1 is at %2 %. Cancel again to end it.")
                  .arg(longest.title)
                  .arg(percent_done(longest.fraction));
  messages_.offer(question_, tr("Cancel it"), [this, ids] {
    if (const auto job = longestOf(ids)) end(ids, *job);
  });
}

void JobCancel::end(const std::vector<quint64>& ids, const Jobs::Running& longest) {
  for (const quint64 id : ids) jobs_.cancel(id);
  messages_.hint(
      tr("%1 was cancelled at %2 %.").arg(longest.title).arg(percent_done(longest.fraction)));
}

void show_jobs(Jobs& jobs, JobCancel& cancel, Frame& frame, Messages& messages) {
  auto* panel = new JobPanel(&frame);
  frame.addUnderTabs(panel);
  QObject::connect(&jobs, &Jobs::added, panel, &JobPanel::addJob);
  QObject::connect(&jobs, &Jobs::endsEarly, panel, &JobPanel::setIterative);
  QObject::connect(&jobs, &Jobs::progressed, panel, &JobPanel::setProgress);
  QObject::connect(&jobs, &Jobs::cancelling, panel, &JobPanel::setCancelling);
  QObject::connect(&jobs, &Jobs::finishing, panel, &JobPanel::setFinishing);
  QObject::connect(&jobs, &Jobs::removed, panel, &JobPanel::removeJob);
  QObject::connect(panel, &JobPanel::cancelRequested, &cancel,
                   [&cancel](quint64 id) { cancel.cancel({id}); });
  QObject::connect(panel, &JobPanel::finishRequested, &jobs, &Jobs::finishEarly);
  QObject::connect(&jobs, &Jobs::failed, &messages, &Messages::fail);
  QObject::connect(&jobs, &Jobs::failureIsOver, &messages, &Messages::retract);
}

QString with_conventions(QString sentence) {
  static const QRegularExpression option(
      "--([a-z-]*[a-z])(?: ('[^']*'|-?\\d\\S*?|[A-Za-z]\\S*?)(?=[.,;:)]*(?:\\s|$)))?");
  const auto schema = io::open_schema();
  const auto& options = schema.descriptions();
  for (auto match = option.match(sentence); match.hasMatch();) {
    qsizetype end = match.capturedEnd(1);
    const auto known =
        std::ranges::find(options, match.captured(1).toStdString(), &ParameterDescription::key);
    if (known != options.end()) {
      const bool is_quoted = match.captured(2).startsWith('\'');
      const std::string value = match.captured(2).remove('\'').toStdString();
      const bool is_choice = std::ranges::count(known->choices, value) > 0;
      const bool is_word = !value.empty() && std::islower(static_cast<unsigned char>(value[0]));
      const bool has_value =
          !value.empty() && (is_choice || is_quoted || value == "all" || !is_word);
      const QString label = schema_text(known->label);
      const QString shown = is_choice ? value_text(*known, value) : QString::fromStdString(value);
      const QString name =
          has_value ? Jobs::tr("“%1: %2”").arg(label, shown) : Jobs::tr("“%1”").arg(label);
      const qsizetype begin = match.capturedStart();
      sentence.replace(begin, (has_value ? match.capturedEnd() : end) - begin, name);
      end = begin + name.size();
    }
    match = option.match(sentence, end);
  }
  return sentence;
}

JobRunner::Post queued_post(QObject* context) {
  return [context](std::function<void()> closure) {
    QMetaObject::invokeMethod(context, std::move(closure), Qt::QueuedConnection);
  };
}

}  // namespace episcope

#include "moc_jobs.cpp"
