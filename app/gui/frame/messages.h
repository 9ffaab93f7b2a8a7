// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>
#include <QString>

namespace episcope {

class Frame;
class MessageBar;

/// Messages for the user, in a line of the frame that blocks nothing.
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
  void dismiss();

 private:
  MessageBar* bar_;
};

}  // namespace episcope
