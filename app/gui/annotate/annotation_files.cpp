// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/annotation_files.h"

#include "annotation/exchange.h"
#include "app/gui/annotate/annotate_controller.h"
#include "app/gui/annotate/segment_controller.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/features.h"
#include "app/gui/shell/frame.h"
#include "app/session/picture.h"
#include "app/session/segmentation.h"
#include "app/session/user_folders.h"
#include "engine/core/error.h"
#include "engine/core/shear.h"
#include "engine/io/base/hdf5_file.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/labels/label_pictures.h"
#include "engine/io/models/scribble_file.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/message_bar.h"
#include "widgets/panels/brush_panel.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>
#include <QPushButton>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

namespace episcope {
AnnotationFiles::AnnotationFiles(const Workbench& bench, AnnotationBar* bar)
    : QObject(&bench.owner),
      bench_(bench),
      session_(bench.session),
      document_(bench.document),
      bar_(bar) {
  addCommands();
  bench.guards.add({[this](Leaving) { return !document_.hasUnsavedChanges(); },
                    [this](Leaving, std::function<void()> go_on) { leave(std::move(go_on)); }});
  connect(&document_, &DocumentController::replaced, this, &AnnotationFiles::showState);
  connect(&document_, &DocumentController::unsavedChanged, this, &AnnotationFiles::showState);
  session_.on_changed([this](Parts parts) {
    if (!parts.has(Part::Scene)) return;
    std::erase_if(seen_, [this](std::uint64_t each) { return !session_.find_scene(each); });
    const QString path = place();
    if (seen_.insert(session_.generation()).second && !path.isEmpty()) known_.note(path_of(path));
    showState();
  });
  showState();
}

void AnnotationFiles::addCommand(const QString& id, const QString& text, const QString& tip,
                                 const QString& icon, const QList<QKeySequence>& keys,
                                 void (AnnotationFiles::*run)()) {
  const bool is_export = id == "export_scribbles";
  bench_.commands.add({.id = "file." + id,
                       .menu = is_export ? Menu::Export : Menu::Labels,
                       .text = text,
                       .tip = tip,
                       .icon = icon,
                       .keys = keys,
                       .run = [this, run] { (this->*run)(); },
                       .section = is_export ? section::kLabels : label_section::kFiles,
                       .enabled = [this] { return session_.scene() != nullptr; }});
}

void AnnotationFiles::addCommands() {
  addCommand("save_scribbles", tr("Save scribbles"),
             tr("Saves labels and scribbles, beside the light field if that folder is writable"),
             "save", {}, &AnnotationFiles::save);
  addCommand("save_scribbles_as", tr("Save scribbles as…"),
             tr("Saves labels and scribbles to another file"), {}, {tr("Ctrl+Shift+S")},
             &AnnotationFiles::saveAsDialog);
  addCommand("compare_labels", tr("Compare with true labels…"),
             tr("Compares the segmentation with the GT_LABELS of another file"), "open", {},
             &AnnotationFiles::compareDialog);
  addCommand("export_scribbles", tr("Scribbles as images…"),
             tr("Writes a PNG image of each painted view"), "picture", {},
             &AnnotationFiles::exportDialog);
  for (const char* id : {"file.save_scribbles", "file.export_scribbles"}) {
    bar_->addAction(bench_.commands.find(id));
  }
}

void AnnotationFiles::showState() {
  const QFileInfo file(place());
  const QString none = tr("no file yet");
  const QString name = file.filePath().isEmpty() ? none : file.fileName();
  bar_->setFileState(!document_.document()           ? QString()
                     : saving_ > 0                   ? tr("saving …")
                     : document_.hasUnsavedChanges() ? tr("%1 · not saved").arg(name)
                     : document_.isInProjectOnly()   ? tr("%1 · in the project only").arg(name)
                     : file.exists()                 ? name
                                                     : none);
}

QString AnnotationFiles::place() const {
  const std::string file = document_.file();
  if (!file.empty()) return QString::fromStdString(file);
  const LightFieldPtr light_field = session_.light_field();
  if (!light_field || !document_.isWhole()) return {};
  const auto beside = label_place(*light_field);
  return beside.empty() || !is_writable(beside) ? QString()
                                                : QString::fromStdString(beside.string());
}

QString AnnotationFiles::suggestion() const {
  const QString known = place();
  if (!known.isEmpty()) return known;
  const QString name = QString::fromStdString(session_.light_field()->info().name);
  return name + "_labels.h5";
}

void AnnotationFiles::save() {
  if (!document_.document()) return;
  if (document_.hasUnsavedChanges() || hasStrokes()) return saveAndThen(nullptr);
  bench_.messages.hint(tr("Nothing is painted yet: there are no scribbles to save."));
}

bool AnnotationFiles::hasStrokes() const {
  return !document_.document()->scribbles().painted_views().empty();
}

void AnnotationFiles::saveAndThen(std::function<void()> then) {
  if (!document_.document()) return;
  const QString path = place();
  if (!path.isEmpty()) return saveTo(path, std::move(then));
  tellReadOnly();
  askForPlace(std::move(then));
}

void AnnotationFiles::tellReadOnly() const {
  if (!document_.isWhole()) return;
  const std::filesystem::path beside = label_place(*session_.light_field());
  if (beside.empty()) return;
  bench_.messages.warn(tr("%1 cannot be written: choose another place for labels and scribbles.")
                           .arg(QString::fromStdString(beside.string())));
}

void AnnotationFiles::askForPlace(std::function<void()> then) {
  if (!document_.document()) return;
  ask_where_to_save(
      bench_,
      {.name = "save_scribbles",
       .title = tr("Save scribbles"),
       .filter = tr("Archive labels (*.h5)"),
       .proposal = suggestion(),
       .confirms_overwrite = false},
      [this, then = std::move(then)](const QString& path) { saveToChosen(path, then); });
}

void AnnotationFiles::saveToChosen(const QString& path, std::function<void()> then) {
  if (path == place() || !QFileInfo::exists(path)) return saveTo(path, std::move(then));
  confirm_replacing(&bench_.window,
                    tr("%1 exists. Replace its labels and scribbles? What else it holds stays.")
                        .arg(QFileInfo(path).fileName()),
                    [this, path, then = std::move(then)] { saveTo(path, then); });
}

std::function<Scribbles()> AnnotationFiles::snapshot() {
  document_.endStroke();
  const AnnotationDocument& document = *document_.document();
  auto layer = std::make_shared<ScribbleLayer>(document.scribbles());
  return [labels = document.labels(), layer] {
    return scribbles_of(AnnotationDocument(labels, std::move(*layer), 0));
  };
}

void AnnotationFiles::saveTo(const QString& path, std::function<void()> then) {
  if (!document_.document()) return;
  if (saving_ != 0 || !known_.has_changed(path_of(path))) {
    write(path, std::move(then));
    return;
  }
  ask_about_changed_file(&bench_.window, path,
                         {.overwrite = [this, path, then] { write(path, then); },
                          .elsewhere = [this, then] { askForPlace(then); },
                          .reload = [this, path] { reload(path); },
                          .of_reloading = tr("Reloading replaces the open labels and strokes.")});
}

void AnnotationFiles::reload(const QString& path) {
  using Read = std::pair<std::shared_ptr<Scribbles>, FileStamp>;
  bench_.jobs.start<Read>(
      Lane::Load, tr("Reading %1").arg(QFileInfo(path).fileName()),
      [scene = session_.scene(), path](const Progress& progress) {
        const FileStamp stamp = stamp_of(path_of(path));
        return Read(
            std::make_shared<Scribbles>(io::read_scribbles(path_of(path), *scene, progress)),
            stamp);
      },
      [this, path, generation = session_.generation()](const Read& read) {
        if (generation != session_.generation()) return;
        const LightFieldPtr light_field = session_.light_field();
        document_.replace(document_from(*read.first, light_field->grid(), light_field->height(),
                                        light_field->width()),
                          true, path.toStdString());
        known_.note(path_of(path), read.second);
        bench_.messages.success(tr("Reloaded: %1").arg(path));
      });
}

void AnnotationFiles::write(const QString& path, std::function<void()> then) {
  if (!document_.document()) return;
  const auto scribbles = snapshot();
  const std::uint64_t generation = session_.generation();
  ++saving_;
  showState();
  bench_.jobs.start<FileStamp>(
      Lane::Export, tr("Saving %1").arg(QFileInfo(path).fileName()),
      [scribbles, path, scene = session_.scene()](const Progress& progress) {
        io::write_scribbles(path_of(path), scribbles(), *scene, progress);
        return stamp_of(path_of(path));
      },
      [this, path, generation, state = document_.document()->state(),
       then = std::move(then)](const FileStamp& stamp) {
        known_.note(path_of(path), stamp);
        document_.noteSaved(generation, state, path.toStdString());
        bench_.messages.written(path);
        if (then) then();
      },
      [this] {
        --saving_;
        showState();
      });
}

void AnnotationFiles::exportDialog() {
  if (!document_.document()) return;
  if (!hasStrokes()) {
    bench_.messages.hint(tr("Nothing is painted yet: there are no scribbles to export."));
    return;
  }
  ask_for_folder(&bench_.window,
                 {.name = "export_scribbles",
                  .title = tr("Folder for the images of the painted views"),
                  .makes_folder = true},
                 [this](const QString& folder) {
                   confirm_replacing(
                       &bench_.window,
                       QDir(folder).entryList({"scribbles_*.png"}, QDir::Files, QDir::Name),
                       [this, folder] { exportPictures(folder); });
                 });
}

void AnnotationFiles::exportPictures(const QString& folder) {
  if (!document_.document()) return;
  bench_.jobs.start<bool>(
      Lane::Export, tr("Writing scribble images"),
      [scribbles = snapshot(), folder, scene = session_.scene()](const Progress&) {
        io::write_scribble_pictures(
            path_of(folder),
            unsheared(scribbles(), {}, scene->light_field->center(), scene->convention.focus_px));
        return true;
      },
      [this, folder](bool) { bench_.messages.written(folder); });
}

void AnnotationFiles::compareDialog() {
  if (!session_.scene()) return;
  ask_for_file(&bench_.window,
               {.name = "compare_labels",
                .title = tr("Compare with true labels"),
                .filter = tr("Archive labels (*.h5 *.hdf5);;All files (*)")},
               [this](const QString& path) { compareWith(path); });
}

void AnnotationFiles::compareWith(const QString& path) {
  if (!session_.scene()) return;
  using Read = std::pair<TrueLabelsPtr, std::vector<LabelInfo>>;
  bench_.jobs.start<Read>(
      Lane::Load, tr("Reading %1").arg(QFileInfo(path).fileName()),
      [scene = session_.scene(), path](const Progress& progress) -> Read {
        return {std::make_shared<ViewStack<std::int32_t>>(
                    io::read_true_labels(path_of(path), *scene, progress)),
                io::read_label_list(io::Hdf5Input(path_of(path)), io::kTrueLabels)};
      },
      [this, path, generation = session_.generation()](const Read& read) {
        if (generation != session_.generation()) return;
        session_.set_true_labels(read.first, read.second);
        bench_.messages.success(tr("Labels are now compared with %1").arg(path));
      });
}

void AnnotationFiles::leave(std::function<void()> go_on) {
  document_.endStroke();
  if (!document_.hasUnsavedChanges()) {
    go_on();
    return;
  }
  if (question_) {
    question_->raise();
    return;
  }
  question_ = new_question_box(
      &bench_.window,
      {.name = "unsaved_scribbles",
       .title = tr("Unsaved scribbles"),
       .text = tr("The scribbles on “%1” have not been saved.")
                   .arg(QString::fromStdString(session_.light_field()->info().name)),
       .buttons = QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel});
  question_->setDefaultButton(QMessageBox::Save);
  connect(question_, &QMessageBox::buttonClicked, this,
          [this, box = question_.data(), go_on = std::move(go_on)](QAbstractButton* button) {
            const auto answer = box->standardButton(button);
            question_ = nullptr;
            if (answer == QMessageBox::Discard) {
              document_.discardChanges();
              go_on();
            } else if (answer == QMessageBox::Save) {
              saveAndThen([this, go_on] { leave(go_on); });
            }
          });
  question_->open();
}

namespace {

struct SegmentationExportText {
  Q_DECLARE_TR_FUNCTIONS(episcope::SegmentationExport)
};

}  // namespace

void ask_to_export_masks(const Workbench& bench, const SegmentController& segment) {
  if (!segment.hasSegmentation()) return;
  const bool has_all = segment.hasAllViews();
  ask_for_folder(
      &bench.window,
      {.name = "export_masks",
       .title = has_all ? SegmentationExportText::tr("Folder for the masks of all views")
                        : SegmentationExportText::tr("Folder for the masks of this view; segment "
                                                     "all views first to save all masks"),
       .makes_folder = true},
      [bench, &segment](const QString& folder) {
        confirm_replacing(&bench.window, QDir(folder).entryList({kListOfMasks}, QDir::Files),
                          [bench, &segment, folder] { export_masks(bench, segment, folder); });
      });
}

void export_masks(const Workbench& bench, const SegmentController& segment, const QString& folder) {
  const auto segmentation = segment.segmentation();
  if (!segmentation) return;
  write_labels_in_background(
      bench, segment, folder,
      [path = std::filesystem::path(folder.toStdString()), segmentation](const Progress& progress) {
        write_label_masks(path, *segmentation, progress);
      });
}

void write_labels_in_background(const Workbench& bench, const SegmentController& segment,
                                const QString& path, std::function<void(const Progress&)> write,
                                const std::function<void()>& written) {
  write_in_background(
      bench.jobs, bench.messages, path, std::move(write),
      [bench, path, written, is_up_to_date = segment.isSegmentationUpToDate()] {
        if (written) written();
        if (is_up_to_date) return;
        bench.messages.warn(
            SegmentationExportText::tr(
                "%1 holds labels that were out of date: strokes or settings changed since.")
                .arg(QFileInfo(path).fileName()));
      });
}

namespace {

QString name_of(const RecoverableJournal& journal) {
  return QString::fromStdString(journal.owner.name);
}

/// What a worker found in a journal, or why it found nothing.
struct Found {
  std::unique_ptr<RecoveredAnnotation> annotation;
  std::uint64_t sample_hash = 0;  ///< Of the light field that is open.
  QString failure;
};

}  // namespace

/// Offers the journals of crashed sessions one after the other, in a bar that does not block.
class RecoveryController : public QObject {
  Q_OBJECT

 public:
  explicit RecoveryController(const Workbench& bench)
      : QObject(&bench.owner),
        bench_(bench),
        session_(bench.session),
        document_(bench.document),
        bar_(named("recoveryBar", new MessageBar(&bench.frame))),
        job_(this) {
    bench.frame.addFloating(bar_);
    connect(&bench.frame, &Frame::settled, this, &RecoveryController::look);
    connect(&document_, &DocumentController::replaced, this, [this] {
      if (!awaited_ || !isOpen(awaited_->owner)) return;
      read(*std::exchange(awaited_, std::nullopt));
    });
  }

  /// Looks for journals in the background and offers the latest.
  void look() {
    using Journals = std::vector<RecoverableJournal>;
    job_.start<Journals>(
        [folder = document_.journalFolder()](const Progress&) {
          return folder.empty() ? Journals() : recoverable_journals(folder);
        },
        [this](Journals journals) {
          left_ = std::move(journals);
          std::ranges::reverse(left_);
          offerNext();
        });
  }

 private:
  [[nodiscard]] bool isOpen(const JournalOwner& owner) const {
    return session_.scene() && session_.input() == owner.source &&
           session_.scene()->convention.focus_px == owner.focus_px;
  }

  void offerNext() {
    if (left_.empty()) return;
    const RecoverableJournal journal = left_.back();
    left_.pop_back();
    offer(journal);
  }

  void offer(const RecoverableJournal& journal) {
    bar_->showMessage(
        Severity::Warning,
        tr("Episcope ended unexpectedly while “%1” was being annotated (%2). Strokes to "
           "recover: %3.")
            .arg(name_of(journal), short_text(journal.last_change))
            .arg(journal.strokes),
        {tr("Recover"), [this, journal] { recover(journal); }},
        {tr("Discard…"), [this, journal] { discard(journal); }});
  }

  void recover(const RecoverableJournal& journal) {
    const auto go_on = [this, journal] {
      if (document_.document() && isOpen(journal.owner)) {
        read(journal);
        return;
      }
      awaited_ = journal;
      open(journal.owner);
    };
    // What was painted meanwhile on the same light field is replaced.
    isOpen(journal.owner) ? bench_.guards.leave(Leaving::Reading, go_on) : go_on();
  }

  void open(const JournalOwner& owner) {
    std::function<void()> then;
    if (owner.focus_px != 0) {
      then = [this, focus_px = owner.focus_px] { bench_.opener.reopenAt(focus_px, nullptr); };
    }
    bench_.opener.open(QString::fromStdString(owner.source), std::move(then));
  }

  void discard(const RecoverableJournal& journal) {
    confirm_discarding(
        &bench_.window,
        tr("This deletes the scribbles on “%1” that were not saved.").arg(name_of(journal)),
        [this, journal] {
          discard_journal(journal.path);
          offerNext();
        },
        [this, journal] { offer(journal); });
  }

  void read(const RecoverableJournal& journal) {
    job_.start<std::shared_ptr<Found>>(
        [journal, light_field = session_.light_field()](const Progress&) {
          auto found = std::make_shared<Found>();
          try {
            found->annotation = std::make_unique<RecoveredAnnotation>(read_journal(journal.path));
            found->sample_hash = light_field->sample_hash();
          } catch (const IoError& error) {
            found->failure = QString::fromUtf8(error.what());
          }
          return found;
        },
        [this, journal](const std::shared_ptr<Found>& found) {
          if (!found->failure.isEmpty()) {
            refuse(found->failure);
          } else {
            takeOver(journal, std::move(*found->annotation), found->sample_hash);
          }
        });
  }

  void takeOver(const RecoverableJournal& journal, RecoveredAnnotation found,
                std::uint64_t sample_hash) {
    const LightFieldPtr light_field = session_.light_field();
    if (!light_field || !isOpen(journal.owner)) return;
    const ScribbleLayer& layer = found.document.scribbles();
    const bool fits = layer.grid() == light_field->grid() &&
                      layer.height() == light_field->height() &&
                      layer.width() == light_field->width();
    if (!fits || (found.owner.sample_hash != 0 && found.owner.sample_hash != sample_hash)) {
      refuse(tr("“%1” is no longer the light field that was annotated. Your work is kept in %2.")
                 .arg(name_of(journal), QString::fromStdString(journal.path.string())));
      return;
    }
    const bool is_kept =
        document_.replace(std::move(found.document), document_.isWhole(), found.owner.file);
    if (is_kept) discard_journal(journal.path);  // else it is the only one
    bench_.frame.showTab("annotate");
    bench_.messages.success(tr("Recovered the annotation of “%1”.").arg(name_of(journal)));
    offerNext();
  }

  void refuse(const QString& sentence) { bar_->showMessage(Severity::Error, sentence); }

  Workbench bench_;
  Session& session_;
  DocumentController& document_;
  MessageBar* bar_;
  std::vector<RecoverableJournal> left_;       // the one to be offered next comes last
  std::optional<RecoverableJournal> awaited_;  // its light field is being opened
  LatestJob job_;
};

void add_recovery(const Workbench& bench) {
  new RecoveryController(bench);
}

}  // namespace episcope

#include "moc_annotation_files.cpp"

#include "annotation_files.moc"
