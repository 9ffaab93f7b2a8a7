// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/opening/result_opener.h"

#include "app/gui/frame/jobs.h"
#include "app/gui/frame/messages.h"
#include "app/session/run/read_result.h"
#include "app/session/run/result_reading.h"
#include "app/session/run/run_estimator.h"
#include "app/session/scene/scene_range.h"
#include "app/session/session.h"

#include <QFileInfo>

#include <memory>
#include <utility>

namespace episcope {
namespace {

struct ReadEstimate : FinishedEstimate {
  bool is_of_others = false;
  std::string differing_options;
  FileStamp stamp;
};

ReadEstimate read_estimate(const LightField& light_field, const std::string& path,
                           const Progress& progress) {
  const FileStamp stamp = stamp_of(path);
  auto estimate = std::make_shared<Estimate>(read_result_of(light_field, path));
  progress.check();
  check_fits(*estimate, light_field, path);
  const bool is_of_others = is_of_other_samples(*estimate, light_field);
  const bool is_moved = estimate->reading.focus_px() != light_field.info().reading.focus_px();
  bring_to_focus(*estimate, light_field, progress);
  const Interval range = display_range(*estimate);
  std::string options = differing_options(*estimate, light_field);
  return {{std::move(estimate), range}, is_of_others && !is_moved, std::move(options), stamp};
}

}  // namespace

bool is_result(const QString& path) {
  try {
    return names_result(path.toStdString());
  } catch (const std::exception&) {
    return false;
  }
}

ResultOpener::ResultOpener(Session& session, Jobs& jobs, Messages& messages, QObject* parent)
    : QObject(parent), session_(session), jobs_(jobs), messages_(messages) {}

void ResultOpener::open(const QString& path) {
  const QString name = QFileInfo(path).fileName();
  jobs_.start<ReadEstimate>(
      Lane::Load, tr("Opening %1").arg(name),
      [light_field = session_.light_field(), path = path.toStdString()](const Progress& progress) {
        return read_estimate(*light_field, path, progress);
      },
      [this, generation = session_.generation(), name, path](const ReadEstimate& read) {
        files_.note(path.toStdString(), read.stamp);
        session_.add_estimate(read.estimate, read.display_range, generation);
        if (!read.differing_options.empty()) {
          messages_.warn(tr("%1 was estimated with%2: its errors may be meaningless. Choose the "
                            "same in Conventions…")
                             .arg(name, QString::fromStdString(read.differing_options)));
        } else if (read.is_of_others) {
          messages_.warn(
              tr("%1 was estimated from different samples than those of this light field: "
                 "its errors may be meaningless.")
                  .arg(name));
        }
      });
}

}  // namespace episcope

#include "moc_result_opener.cpp"
