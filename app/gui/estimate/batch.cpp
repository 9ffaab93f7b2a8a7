// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/estimate/batch.h"

#include "app/gui/estimate/method_runs.h"
#include "app/session/session.h"
#include "engine/disparity/registry.h"
#include "widgets/estimate/batch_dialog.h"
#include "widgets/estimate/method_panel.h"

namespace episcope {
namespace {

std::vector<BatchDialog::Row> method_rows(const std::string& chosen) {
  std::vector<BatchDialog::Row> rows;
  for (const Estimator& each : registered_estimators()) {
    rows.push_back({QString::fromStdString(each.info.id), QString::fromStdString(each.info.name),
                    each.info.id == chosen});
  }
  return rows;
}

std::vector<BatchDialog::Row> scene_rows(const Session& session) {
  std::vector<BatchDialog::Row> rows;
  for (const OpenScene* each : session.scenes()) {
    rows.push_back({QString::number(each->id), QString::fromStdString(each->name), true});
  }
  return rows;
}

EstimateRequest default_request(const std::string& method) {
  return {method, {}, {.views = views_of(find_estimator(method).info.all_views)}};
}

}  // namespace

void ask_for_batch(const Workbench& bench, MethodRuns& runs, const RunRequest& form) {
  auto* dialog =
      new BatchDialog(method_rows(form.method), scene_rows(bench.session), &bench.window);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  QObject::connect(dialog, &QDialog::accepted, &runs, [bench, &runs, form, dialog] {
    for (const QString& method : dialog->methods()) {
      const std::string id = method.toStdString();
      const EstimateRequest request = id == form.method ? request_of(form) : default_request(id);
      for (const QString& scene : dialog->scenes()) {
        if (const auto* open = bench.session.find_scene(scene.toULongLong())) {
          runs.run(request, *open);
        }
      }
    }
  });
  dialog->open();
}

}  // namespace episcope
