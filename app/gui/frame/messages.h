// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>
#include <QString>

#include <functional>

namespace episcope {

class Frame;
class MessageBar;

/// Messages for the user, floating over the view, that block nothing.
class Messages : public QObject {
  Q_OBJECT

 public:
  explicit Messages(Frame& frame);

  /// No failure: something to do first.
  void hint(const QString& sentence);
  void success(const QString& sentence);
  void warn(const QString& sentence);
  void fail(const QString& sentence);
  /// "Written: …".
  void written(const QString& path);
  /// What was done, with a button that does something about it.
  void offer(const QString& sentence, const QString& button, std::function<void()> run);
  void dismiss();
  [[nodiscard]] bool isShown(const QString& sentence) const;
  /// Takes a sentence back that no longer holds, if it is still what is shown.
  void retract(const QString& sentence);

 private:
  MessageBar* bar_;
};

}  // namespace episcope
