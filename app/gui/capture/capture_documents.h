// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"
#include "app/session/capture_document.h"

#include <QObject>
#include <QString>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>

namespace episcope {

class Messages;

/// What the user does in the Capture tab: a document for each open light field, which the session
/// keeps with it. A light field that is opened after another goes on with its lens; what was
/// prepared before any was open belongs to the first.
class CaptureDocuments : public QObject {
  Q_OBJECT

 public:
  CaptureDocuments(const Workbench& bench, QObject* parent);

  /// Of the light field that is shown, with poses.
  [[nodiscard]] const CaptureDocument& now() const { return documents_.at(scene_); }
  /// Why the current object has no pose although it has pairs enough; empty = no such reason.
  [[nodiscard]] const QString& problem() const { return problem_; }
  /// Meshes of all open light fields.
  [[nodiscard]] std::set<std::string> meshes() const;

  /// Changes the document of the light field that is shown.
  void change(const std::function<void(CaptureDocument&)>& change);
  /// The same of the light field that was shown when `scene` was `Session::generation`; what began
  /// with none goes on with the one that came next. Returns false, and does nothing, if it is
  /// closed.
  [[nodiscard]] bool changeOf(std::uint64_t scene,
                              const std::function<void(CaptureDocument&)>& change);
  /// What the light field that is shown begins with; nothing of it can be undone.
  void begin(CaptureWork work);
  /// Light fields that were just opened are told of later: this follows at once.
  void follow();

 signals:
  /// The document that is shown changed, or another one is.
  void changed();

 private:
  /// The last time that there was no light field, and the one that came next.
  struct Heir {
    std::uint64_t none = 0;
    std::uint64_t next = 0;
  };

  [[nodiscard]] CaptureWork firstWork() const;
  void settle();

  Workbench bench_;
  std::map<std::uint64_t, CaptureDocument> documents_;  // by OpenScene::id
  std::uint64_t scene_ = 0;
  bool shows_none_ = true;
  Heir heir_;
  QString problem_;
};

/// Whether a light field can be written there: its name ends in .h5 and nothing has it yet, so that
/// none is lost; if not, the user is told.
[[nodiscard]] bool is_new_light_field(const QString& path, Messages& messages);

}  // namespace episcope
