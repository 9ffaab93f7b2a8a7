// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/save/known_files.h"

#include <QObject>
#include <QString>

namespace episcope {

class Jobs;
class Messages;
class Session;

/// Whether a path names a result. False for what cannot be read: opening it tells what is wrong.
[[nodiscard]] bool is_result(const QString& path);

/// Adds result files, and maps of other programs, to the results of the open light field, in the
/// background. Warns of results that may belong to another light field.
class ResultOpener : public QObject {
  Q_OBJECT

 public:
  ResultOpener(Session& session, Jobs& jobs, Messages& messages, QObject* parent);

  /// Precondition: a light field is open.
  void open(const QString& path);
  /// Files that results were read from or written to.
  [[nodiscard]] KnownFiles& files() { return files_; }

 private:
  Session& session_;
  Jobs& jobs_;
  Messages& messages_;
  KnownFiles files_;
};

}  // namespace episcope
