// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/scene/document_controller.h"
#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/segmentation.h"
#include "app/session/session.h"
#include "engine/io/models/labels/label_export.h"

#include <QList>
#include <QObject>
#include <QPointer>
#include <QString>
#include <QStringList>
#include <QUrl>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace episcope {

class AnnotationBar;
class ImportLabelsDialog;
class SegmentController;

/// What imported labels become.
enum class LabelUse {
  Strokes,       ///< Painted where nothing is painted; the segmentation is learned from them.
  Segmentation,  ///< Shown, checked and exported as labels that were made here.
  TrueLabels     ///< Compared with the segmentation.
};

/// Imports labels of other tools: reads files, shows what they hold, and asks once what they are to
/// become. Files that are dropped on the window while the Annotate tab is shown are imported, too.
class LabelImporter : public QObject {
  Q_OBJECT

 public:
  /// Adds its command, with a button on the bar.
  LabelImporter(const Workbench& bench, AnnotationBar* bar);

  /// Asks for files, then as `open`.
  void ask();
  /// Reads files, or a folder, and opens the dialog.
  void open(const QStringList& paths);
  /// Gives labels of the light field in front their use, and tells how they were understood.
  void use(const io::ImportedLabels& labels, LabelUse use, const QString& name);

 signals:
  /// Labels that are to be shown as the segmentation of the light field in front.
  void segmented(const LabelingPtr& labeling);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  /// What is to be read, and how.
  struct Asked {
    QStringList paths{};
    std::optional<std::vector<std::int32_t>> ignored{};
    QString table{};  ///< Of colors; empty = none.
    bool zero_is_label = false;
  };
  void read();
  void show(const QStringList& paths, std::shared_ptr<io::ImportedLabels> labels);
  void useAsSegmentation(const io::ImportedLabels& labels);
  void passOn(const QList<QUrl>& urls, QObject* window);

  Workbench bench_;
  Session& session_;
  DocumentController& document_;
  QPointer<ImportLabelsDialog> dialog_;
  Asked asked_, shown_;
  LatestJob look_{this};
  bool is_passing_on_ = false;  // what was dropped, to the window
};

/// Form in which labels are exported.
struct LabelTarget {
  enum class Kind { Hdf5, Hdf5WithProbabilities, Folder, Picture };
  Kind kind = Kind::Hdf5;
  io::LabelForm form = io::LabelForm::Indexed;  ///< Of a folder.
  bool has_views = false;                       ///< Whether a folder holds the views as well.
};

void add_label_export(const Workbench& bench, const SegmentController& segment);

/// Asks for the form, with a warning if the labels are out of date, then for the place.
void ask_to_export_labels(const Workbench& bench, const SegmentController& segment);

/// Writes the labels that cover the current view, in the background.
void export_labels(const Workbench& bench, const SegmentController& segment, const QString& path,
                   const LabelTarget& target);

}  // namespace episcope
