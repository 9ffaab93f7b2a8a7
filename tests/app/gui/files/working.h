// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/estimate/estimate_controller.h"
#include "app/gui/files/autosave.h"
#include "app/gui/files/project_controller.h"
#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/scene_switcher.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"

#include <QCoreApplication>
#include <QTest>

namespace episcope {

/// The window with projects.
class Working : public WindowFixture {
 public:
  Session& session() { return window.bench().session; }
  ProjectController& project() { return find<ProjectController>(window); }
  Autosave& autosave() { return find<Autosave>(window); }

  /// Estimates the center view of what is shown.
  void estimate(const std::string& method = "st_ch_l") {
    const std::size_t before = session().estimates().size();
    find<EstimateController>(window).run({method, {}, {.views = ViewSelection::Center}});
    QTRY_COMPARE_WITH_TIMEOUT(session().estimates().size(), before + 1, kScenePatience);
    QCoreApplication::processEvents();
  }
  /// Shows an open scene and waits until it is there.
  void show(std::uint64_t scene) {
    window.bench().scenes.show(scene);
    QTRY_COMPARE_WITH_TIMEOUT(session().generation(), scene, kScenePatience);
    QTRY_VERIFY_WITH_TIMEOUT(window.bench().document.document(), kPatience);
    QCoreApplication::processEvents();
  }
  void saveAs(const QString& path) {
    bool is_saved = false;
    project().saveTo(path, [&is_saved] { is_saved = true; });
    QTRY_VERIFY_WITH_TIMEOUT(is_saved, kScenePatience);
  }
  void open(const QString& path, std::size_t scenes) {
    window.bench().opener.open(path);
    QTRY_COMPARE_WITH_TIMEOUT(session().scenes().size(), scenes, kScenePatience);
    QTRY_VERIFY_WITH_TIMEOUT(session().scene() && window.bench().document.document(),
                             kScenePatience);
    QCoreApplication::processEvents();
  }
  std::size_t resultCount() {
    std::size_t count = 0;
    for (const OpenScene* each : session().scenes()) count += each->estimates.size();
    return count;
  }
};

}  // namespace episcope
