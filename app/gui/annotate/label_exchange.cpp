// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/label_exchange.h"

#include "annotation/exchange.h"
#include "app/gui/annotate/annotate_controller.h"
#include "app/gui/annotate/annotation_files.h"
#include "app/gui/annotate/segment_controller.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/session/label_review.h"
#include "app/session/picture.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/labels/color_table.h"
#include "engine/io/models/scribble_file.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/picture.h"
#include "widgets/controls/text.h"
#include "widgets/panels/brush_panel.h"

#include <QButtonGroup>
#include <QCheckBox>
#include <QComboBox>
#include <QCoreApplication>
#include <QDialog>
#include <QDialogButtonBox>
#include <QDropEvent>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMimeData>
#include <QPixmap>
#include <QPushButton>
#include <QRadioButton>
#include <QScopedValueRollback>
#include <QUrl>
#include <QVBoxLayout>

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

namespace episcope {
namespace {

constexpr int kPreviewSide = 360;  ///< In px, at most.

/// A view in gray with labels over it.
QImage preview_of(const LightField& field, const ViewScribbles& one,
                  const std::vector<LabelInfo>& infos) {
  std::map<std::int32_t, Rgb> colors;
  for (const LabelInfo& label : infos) colors[label.id] = label.color;
  Image<std::uint8_t> picture(field.height(), field.width(), 4);
  std::vector<float> row(static_cast<std::size_t>(field.width()) * field.channels());
  for (int y = 0; y < field.height(); ++y) {
    field.read_row(one.view, y, 0, field.width(), row.data());
    for (int x = 0; x < field.width(); ++x) {
      const float sample = row[static_cast<std::size_t>(x) * field.channels()];
      const auto gray = static_cast<std::uint8_t>(std::clamp(sample, 0.0F, 1.0F) * 255);
      const std::int32_t id = one.labels.at(y, x);
      std::uint8_t* pixel = &picture.at(y, x);
      const auto known = colors.find(id);
      const Rgb color = known == colors.end() ? label_color(id) : known->second;
      for (std::size_t c = 0; c < 3; ++c) {
        pixel[c] = id > 0 ? static_cast<std::uint8_t>((3 * color[c] + gray) / 4) : gray;
      }
      pixel[3] = 255;
    }
  }
  return to_qimage(std::move(picture));
}

const ViewScribbles& nearest_view(const Scribbles& labels, ViewIndex view) {
  return *std::ranges::min_element(labels.views, {}, [view](const ViewScribbles& one) {
    return std::abs(one.view.v - view.v) + std::abs(one.view.u - view.u);
  });
}

/// Ids between commas; empty for another text.
std::optional<std::vector<std::int32_t>> ids_in(const QString& text) {
  std::vector<std::int32_t> ids;
  for (const QString& word : text.split(',', Qt::SkipEmptyParts)) {
    bool is_number = false;
    ids.push_back(word.trimmed().toInt(&is_number));
    if (!is_number) return std::nullopt;
  }
  return ids;
}

QLabel* wrapped_label(const QString& name, QWidget* parent) {
  auto* label = named(name, new QLabel(parent));
  label->setWordWrap(true);
  label->setTextFormat(Qt::PlainText);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  return label;
}

}  // namespace

/// Shows labels that were read, and asks for their use.
class ImportLabelsDialog : public QDialog {
  Q_OBJECT

 public:
  /// `has_labels`: the light field in front has labels that a segmentation replaces for good.
  ImportLabelsDialog(QWidget* parent, bool has_labels);

  void showLabels(const LightField& field, ViewIndex view,
                  std::shared_ptr<const io::ImportedLabels> labels);
  /// The labels that a signal asked for are shown, or cannot be read.
  /// Returns whether what was asked for last is shown, or still being read.
  bool readEnded();
  /// Waits for labels that were asked for.
  void accept() override;
  [[nodiscard]] const std::shared_ptr<const io::ImportedLabels>& labels() const { return labels_; }
  [[nodiscard]] LabelUse chosenUse() const { return static_cast<LabelUse>(uses_->checkedId()); }

 signals:
  /// Other ids are to count as unlabeled; nothing: those that usually do.
  void ignoredChanged(const std::optional<std::vector<std::int32_t>>& ids);
  void tableChosen(const QString& path);
  void zeroChosen(bool is_label);

 private:
  /// Whether it holds ids, or nothing.
  bool takeIgnored();
  void askForTable();
  void addUse(LabelUse use, const QString& name, const QString& text);

  QLabel* preview_;
  QLabel* content_;
  QLabel* notes_;
  QLineEdit* ignored_;
  QButtonGroup* uses_;
  QVBoxLayout* layout_;
  std::shared_ptr<const io::ImportedLabels> labels_;
  int reading_ = 0;        // What was asked for,
  bool is_stale_ = false;  // and is not yet shown.
  bool is_accepted_ = false;
};

// Names the box of the dialog in the place of the option.
QString note_words(const std::string& note) {
  return finding_words(note).replace("--first-label 0", ImportLabelsDialog::tr("“0 is a label”"));
}

ImportLabelsDialog::ImportLabelsDialog(QWidget* parent, bool has_labels)
    : QDialog(parent),
      preview_(named("importLabels.preview", new QLabel(this))),
      content_(wrapped_label("importLabels.content", this)),
      notes_(wrapped_label("importLabels.notes", this)),
      ignored_(named("importLabels.ignored", new QLineEdit(this))),
      uses_(new QButtonGroup(this)),
      layout_(new QVBoxLayout(this)) {
  setObjectName("importLabels");
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowTitle(tr("Import labels"));
  preview_->setAlignment(Qt::AlignCenter);
  ignored_->setPlaceholderText(tr("255 where all labels are smaller"));
  ignored_->setToolTip(tr("Ids between commas that mean “unlabeled”, besides 0; - for none"));
  layout_->addWidget(preview_);
  layout_->addWidget(content_);
  layout_->addWidget(notes_);
  auto* form = new QFormLayout;
  form->addRow(tr("Unlabeled"), ignored_);
  auto* zero = named("importLabels.zero", new QCheckBox(tr("0 is a label"), this));
  zero->setToolTip(tr("Raises all ids by one, so that 0 means none"));
  connect(zero, &QCheckBox::toggled, this, [this](bool is_label) {
    ++reading_;
    is_stale_ = true;
    emit zeroChosen(is_label);
  });
  form->addRow({}, zero);
  auto* table = named("importLabels.table", new QPushButton(tr("Table…"), this));
  table->setAutoDefault(false);
  table->setToolTip(tr("What the colors of pictures mean: lines r,g,b,id,name, or a labelmap.txt"));
  connect(table, &QPushButton::clicked, this, &ImportLabelsDialog::askForTable);
  form->addRow(tr("Colors"), table);
  layout_->addLayout(form);
  addUse(LabelUse::Strokes, "strokes", tr("As &strokes: the segmentation is learned from them"));
  addUse(LabelUse::Segmentation, "segmentation",
         tr("As s&egmentation: shown, checked and exported as labels"));
  addUse(LabelUse::TrueLabels, "truth",
         tr("As &true labels: the segmentation is compared with them"));
  uses_->button(static_cast<int>(LabelUse::Strokes))->setChecked(true);
  auto* warning = wrapped_label("importLabels.replaced", this);
  warning->setText(
      tr("The labels shown now are replaced. A button in the message that follows "
         "brings them back."));
  warning->hide();
  layout_->addWidget(warning);
  connect(uses_, &QButtonGroup::idToggled, this,
          [=, this] { warning->setVisible(has_labels && chosenUse() == LabelUse::Segmentation); });
  layout_->addWidget(make_answers(this, "importLabels.import", tr("Import")));
  connect(ignored_, &QLineEdit::editingFinished, this, &ImportLabelsDialog::takeIgnored);
}

bool ImportLabelsDialog::takeIgnored() {
  const QString text = ignored_->text().trimmed();
  const auto ids = ids_in(text == "-" ? QString() : text);
  if (!ids || !ignored_->isModified()) return ids.has_value();
  ignored_->setModified(false);
  ++reading_;
  is_stale_ = true;
  emit ignoredChanged(text.isEmpty() ? std::nullopt : ids);
  return true;
}

void ImportLabelsDialog::askForTable() {
  ask_for_file(this,
               {.name = "import_color_table",
                .title = tr("Table of colors"),
                .filter = tr("Tables (*.csv *.txt);;All files (*)")},
               [this](const QString& path) {
                 ++reading_;
                 is_stale_ = true;
                 emit tableChosen(path);
               });
}

bool ImportLabelsDialog::readEnded() {
  if (reading_ == 0 || --reading_ > 0) return true;
  if (is_stale_) ignored_->setModified(true);
  const bool goes_on = std::exchange(is_accepted_, false) && !is_stale_;
  if (goes_on) QDialog::accept();
  return !is_stale_;
}

void ImportLabelsDialog::accept() {
  if (!takeIgnored()) return ignored_->setFocus();
  is_accepted_ = reading_ > 0;
  if (!is_accepted_) QDialog::accept();
}

void ImportLabelsDialog::addUse(LabelUse use, const QString& name, const QString& text) {
  auto* button = named("importLabels." + name, new QRadioButton(text, this));
  uses_->addButton(button, static_cast<int>(use));
  layout_->addWidget(button);
}

void ImportLabelsDialog::showLabels(const LightField& field, ViewIndex view,
                                    std::shared_ptr<const io::ImportedLabels> labels) {
  labels_ = std::move(labels);
  is_stale_ = reading_ > 1;  // else this is what was asked for last
  const Scribbles& scribbles = labels_->scribbles;
  const ViewScribbles& shown = nearest_view(scribbles, view);
  const QImage picture = preview_of(field, shown, scribbles.labels);
  preview_->setPixmap(QPixmap::fromImage(picture.scaled(
      QSize(kPreviewSide, kPreviewSide).boundedTo(picture.size()), Qt::KeepAspectRatio)));
  std::map<std::int32_t, std::size_t> counts;
  for (const std::int32_t id : shown.labels) ++counts[id];
  counts.erase(0);
  QStringList texts;
  for (const auto& [id, count] : counts) {
    const auto known = std::ranges::find(scribbles.labels, id, &LabelInfo::id);
    const QString name = known == scribbles.labels.end() ? QString() : " " + label_name(*known);
    texts << QString("%1%2").arg(id).arg(name);
  }
  content_->setText(
      tr("%n view(s) with labels. View %1: %2", nullptr, static_cast<int>(scribbles.views.size()))
          .arg(QString::fromStdString(view_text(shown.view)), listed(texts)));
  QStringList notes;
  for (const std::string& note : labels_->notes) notes << note_words(note);
  notes_->setText(notes.join('\n'));
  notes_->setVisible(!notes.isEmpty());
}

LabelImporter::LabelImporter(const Workbench& bench, AnnotationBar* bar)
    : QObject(&bench.owner), bench_(bench), session_(bench.session), document_(bench.document) {
  bench.commands.add(
      {.id = "file.import_labels",
       .menu = Menu::Labels,
       .text = tr("Import labels…"),
       .tip = tr("Reads labels of other tools, as strokes, as segmentation or as true labels"),
       .icon = "open",
       .run = [this] { ask(); },
       .section = label_section::kFiles,
       .enabled = [this] { return session_.scene() != nullptr; }});
  bar->addAction(bench.commands.find("file.import_labels"));
  // Hears of drops before what opens light fields does.
  connect(&bench.frame, &Frame::tabShown, this, [this] { bench_.window.installEventFilter(this); });
}

void LabelImporter::ask() {
  if (!document_.document()) return;
  ask_for_files_or_folder(
      &bench_.window,
      {.name = "import_labels",
       .title = tr("Import labels"),
       .filter = tr("Labels (*.h5 *.hdf5 *.png *.bmp *.tif *.tiff *.pgm *.npy *.npz *.mat "
                    "*.json);;All files (*)")},
      [this](const QStringList& paths) { open(paths); });
}

void LabelImporter::open(const QStringList& paths) {
  if (dialog_) dialog_->close();
  asked_ = {paths};
  read();
}

void LabelImporter::read() {
  const QStringList& paths = asked_.paths;
  if (!document_.document() || paths.isEmpty()) return;
  QStringList files = paths;
  // A picture that was exported stands for all of them.
  const QFileInfo first(paths.front());
  const bool is_exported =
      first.fileName().startsWith("scribbles_") && io::is_image_name(path_of(first.fileName()));
  if (paths.size() == 1 && is_exported) files = {first.path()};
  using Read = std::shared_ptr<io::ImportedLabels>;
  bench_.jobs.start<Read>(
      Lane::Load, tr("Importing %1").arg(first.fileName()),
      [scene = session_.scene(), files, asked = asked_,
       known = document_.document()->labels().labels()](const Progress& progress) {
        std::vector<std::filesystem::path> places;
        for (const QString& file : files) places.push_back(path_of(file));
        io::LabelReading reading{.known = {known.begin(), known.end()},
                                 .ignored = asked.ignored,
                                 .zero_is_label = asked.zero_is_label};
        if (!asked.table.isEmpty()) reading.table = io::read_color_table(path_of(asked.table));
        auto labels = std::make_shared<io::ImportedLabels>(
            io::read_labels(places, *scene, reading, progress));
        const std::string renumbered =
            io::renumber_labels(labels->scribbles, LabelSet::kMaxId, {known.begin(), known.end()});
        if (!renumbered.empty()) labels->notes.push_back(renumbered);
        std::ranges::move(stroke_notes(labels->scribbles, scene->truth->labels),
                          std::back_inserter(labels->notes));
        return labels;
      },
      [this, asked = asked_, generation = session_.generation()](const Read& labels) {
        if (generation != session_.generation()) return;
        shown_ = asked;
        show(asked.paths, labels);
      },
      [this, dialog = dialog_] {
        if (dialog && !dialog->readEnded()) asked_ = shown_;  // it failed: not again
      });
}

void LabelImporter::show(const QStringList& paths, std::shared_ptr<io::ImportedLabels> labels) {
  const LightFieldPtr field = session_.light_field();
  if (dialog_) {
    dialog_->showLabels(*field, session_.view(), std::move(labels));
    return;
  }
  const KeptLabels& kept = session_.labels();
  const bool has_labels = kept.is_worth_keeping() && !kept.is_saved;
  dialog_ = new ImportLabelsDialog(&bench_.window, has_labels);
  dialog_->showLabels(*field, session_.view(), std::move(labels));
  connect(dialog_, &ImportLabelsDialog::ignoredChanged, this,
          [this](const std::optional<std::vector<std::int32_t>>& ids) {
            asked_.ignored = ids;
            read();
          });
  connect(dialog_, &ImportLabelsDialog::zeroChosen, this, [this](bool is_label) {
    asked_.zero_is_label = is_label;
    read();
  });
  connect(dialog_, &ImportLabelsDialog::tableChosen, this, [this](const QString& path) {
    asked_.table = path;
    read();
  });
  connect(dialog_, &QDialog::accepted, this,
          [this, dialog = dialog_.data(), paths, generation = session_.generation()] {
            if (generation != session_.generation()) return;
            use(*dialog->labels(), dialog->chosenUse(), QFileInfo(paths.front()).fileName());
          });
  dialog_->open();
}

void LabelImporter::use(const io::ImportedLabels& labels, LabelUse use, const QString& name) {
  const LightField& field = *session_.light_field();
  if (use == LabelUse::TrueLabels) {
    session_.set_true_labels(std::make_shared<ViewStack<std::int32_t>>(io::stack_of(
                                 labels.scribbles, {field.grid(), field.height(), field.width()})),
                             labels.scribbles.labels);
    bench_.messages.success(tr("Labels are now compared with %1").arg(name));
    return;
  }
  if (use == LabelUse::Segmentation) {
    useAsSegmentation(labels);
  } else if (!document_.edit([&](AnnotationDocument& document) {
               import_scribbles(document, labels.scribbles);
             })) {
    bench_.messages.hint(tr("%1 contains no new scribbles.").arg(name));
    return;
  }
  QStringList sentences{tr("Imported: %1").arg(name)};
  for (const std::string& note : labels.notes) sentences << note_words(note);
  bench_.messages.success(sentences.join("\n"));
}

void LabelImporter::useAsSegmentation(const io::ImportedLabels& labels) {
  const LightField& field = *session_.light_field();
  auto labeling = std::make_shared<Labeling>();
  labeling->labels = io::stack_of(labels.scribbles, {field.grid(), field.height(), field.width()});
  const AnnotationDocument imported =
      document_from(labels.scribbles, field.grid(), field.height(), field.width(), 0);
  const std::vector<LabelInfo> infos = imported.labels().labels();
  for (const LabelInfo& info : infos) labeling->probabilities.ids.push_back(info.id);
  document_.edit([&](AnnotationDocument& document) {
    import_scribbles(document, {{}, infos}, EditKind::ImportSegmentation);  // names and colors
  });
  if (!labeling->labels.contains(session_.view())) session_.set_view(labeling->labels.first());
  emit segmented(labeling);
}

// What the files hold is looked at in the background; others go to the window.
bool LabelImporter::eventFilter(QObject* watched, QEvent* event) {
  const bool is_asked = event->type() == QEvent::Drop && !is_passing_on_ && document_.document() &&
                        bench_.frame.shownTab() == "annotate";
  if (!is_asked) return QObject::eventFilter(watched, event);
  auto* drop = static_cast<QDropEvent*>(event);
  const QList<QUrl> urls = drop->mimeData()->urls();
  if (urls.isEmpty() || !std::ranges::all_of(urls, &QUrl::isLocalFile)) return false;
  drop->acceptProposedAction();
  const LightField& field = *session_.light_field();
  look_.start<bool>(
      [urls, shape = io::FieldShape{field.grid(), field.height(), field.width()}](const Progress&) {
        return std::ranges::all_of(urls, [&](const QUrl& url) {
          return io::holds_labels_only(path_of(url.toLocalFile()), &shape);
        });
      },
      [this, urls, watched](bool are_labels) {
        if (!are_labels) return passOn(urls, watched);
        QStringList paths;
        for (const QUrl& url : urls) paths << url.toLocalFile();
        open(paths);
      });
  return true;
}

void LabelImporter::passOn(const QList<QUrl>& urls, QObject* window) {
  QMimeData data;
  data.setUrls(urls);
  QDragEnterEvent enter({}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QDropEvent drop({}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  const QScopedValueRollback passing_on(is_passing_on_, true);
  QCoreApplication::sendEvent(window, &enter);  // else Qt drops it on nothing
  QCoreApplication::sendEvent(window, &drop);
}

namespace {

/// Asks for the form of exported labels.
class ExportLabelsDialog : public QDialog {
  Q_OBJECT

 public:
  ExportLabelsDialog(QWidget* parent, const Labeling& labeling, bool is_up_to_date);

  [[nodiscard]] const LabelTarget& target() const { return targets_.at(form_->currentIndex()); }
  [[nodiscard]] bool hasViews() const { return views_->isEnabled() && views_->isChecked(); }

 private:
  void addForm(const QString& text, const LabelTarget& target) {
    form_->addItem(text);
    targets_.push_back(target);
  }

  QComboBox* form_;
  QCheckBox* views_;
  std::vector<LabelTarget> targets_;
};

ExportLabelsDialog::ExportLabelsDialog(QWidget* parent, const Labeling& labeling,
                                       bool is_up_to_date)
    : QDialog(parent),
      form_(named("exportLabels.form", new QComboBox(this))),
      views_(named("exportLabels.views", new QCheckBox(this))) {
  using Kind = LabelTarget::Kind;
  setObjectName("exportLabels");
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowTitle(tr("Export labels"));
  views_->setText(tr("With the views as pictures"));
  views_->setChecked(true);
  addForm(tr("Labels (HDF5)"), {Kind::Hdf5});
  addForm(tr("Labels and probabilities (HDF5)"), {Kind::Hdf5WithProbabilities});
  const bool has_probabilities = !labeling.probabilities.empty();
  if (!has_probabilities) set_item_enabled(form_, form_->count() - 1, false);
  addForm(tr("PNG with a palette, one for each view"), {Kind::Folder, io::LabelForm::Indexed});
  addForm(tr("PASCAL VOC"), {Kind::Folder, io::LabelForm::Voc});
  addForm(tr("COCO"), {Kind::Folder, io::LabelForm::Coco});
  addForm(tr("labelme"), {Kind::Folder, io::LabelForm::Labelme});
  addForm(tr("Picture of this view (PNG)"), {Kind::Picture});
  auto* extent = wrapped_label("exportLabels.extent", this);
  QString text = labeling.labels.grid().count() > 1
                     ? tr("Labels of all views.")
                     : tr("Labels of this view; segment all views first to export all.");
  if (!has_probabilities) {
    text += ' ' + tr("They were read from a file: segment again to export probabilities as well.");
  }
  extent->setText(text);
  auto* warning = wrapped_label("exportLabels.warning", this);
  warning->setText(tr("These labels are out of date: strokes or settings changed since."));
  warning->setVisible(!is_up_to_date);
  auto* form = new QFormLayout;
  form->addRow(tr("Form"), form_);
  auto* answers = make_answers(this, "exportLabels.export", tr("Export…"));
  make_column(this, {extent, warning, form, views_, answers}, {.margins = kStyleMargins});
  const auto follow = [this] {
    const LabelTarget& chosen = target();
    views_->setEnabled(chosen.kind == Kind::Folder && chosen.form != io::LabelForm::Indexed);
  };
  connect(form_, &QComboBox::currentIndexChanged, this, follow);
  follow();
}

void ask_for_place(const Workbench& bench, const SegmentController& segment,
                   const LabelTarget& target) {
  using Kind = LabelTarget::Kind;
  const bool is_folder = target.kind == Kind::Folder;
  const QString suffix = is_folder ? QString() : target.kind == Kind::Picture ? ".png" : ".h5";
  const QString name = QString::fromStdString(bench.session.light_field()->info().name);
  ask_where_to_save(
      bench,
      {.name = "export_labels",
       .title = is_folder ? ExportLabelsDialog::tr("New folder for the labels")
                          : ExportLabelsDialog::tr("Export labels"),
       .filter = is_folder                      ? ExportLabelsDialog::tr("Folder (*)")
                 : target.kind == Kind::Picture ? ExportLabelsDialog::tr("Picture (*.png)")
                                                : ExportLabelsDialog::tr("Labels (*.h5)"),
       .proposal = name + "_labels" + suffix},
      [bench, &segment, target](const QString& path) {
        export_labels(bench, segment, path, target);
      });
}

}  // namespace

void add_label_export(const Workbench& bench, const SegmentController& segment) {
  bench.commands.add(
      {.id = "segment.export",
       .menu = Menu::Export,
       .text = ExportLabelsDialog::tr("Labels…"),
       .tip = ExportLabelsDialog::tr("Writes labels as HDF5, or in the forms of other "
                                     "tools: PNG, VOC, COCO, labelme"),
       .icon = "export",
       .run = [bench, &segment] { ask_to_export_labels(bench, segment); },
       .section = section::kLabels,
       .enabled = [&segment] { return segment.hasSegmentation(); }});
}

void ask_to_export_labels(const Workbench& bench, const SegmentController& segment) {
  const auto segmentation = segment.segmentation();
  if (!segmentation) {
    bench.messages.hint(ExportLabelsDialog::tr(
        "Nothing is segmented yet: paint two labels, then update the segmentation."));
    return;
  }
  auto* dialog = new ExportLabelsDialog(&bench.window, *segmentation->labeling,
                                        segment.isSegmentationUpToDate());
  QObject::connect(dialog, &QDialog::accepted, &bench.owner, [bench, &segment, dialog] {
    LabelTarget target = dialog->target();
    target.has_views = dialog->hasViews();
    ask_for_place(bench, segment, target);
  });
  dialog->open();
}

namespace {

std::string write_folder(const std::filesystem::path& folder, const Segmentation& segmentation,
                         const LabelTarget& target, const Scene& scene, const Progress& progress) {
  const Labeling& labeling = *segmentation.labeling;
  const auto labels = finished_labels(labeling, segmentation.finish, progress.part(0, 0.3));
  return io::write_label_folder(
      folder, target.form,
      {labels, infos_of(labeling.probabilities.ids, segmentation.labels),
       target.has_views ? scene.light_field : nullptr, io::label_places(scene)},
      progress.part(0.3, 1));
}

}  // namespace

void export_labels(const Workbench& bench, const SegmentController& segment, const QString& path,
                   const LabelTarget& target) {
  using Kind = LabelTarget::Kind;
  const auto segmentation = segment.segmentation();
  if (!segmentation) return;
  const std::filesystem::path place = path_of(path);
  std::function<void(const Progress&)> write;
  const auto told = std::make_shared<std::string>();
  if (target.kind == Kind::Picture) {
    const auto source = segment.map_source(render::Quantity::Segmentation, bench.session.view());
    if (!source || !has_suffix(path, {"png"}, bench.messages)) return;
    write = [place, source = *source](const Progress&) {
      io::write_picture(place, map_picture(*make_map(source), {}).view());
    };
  } else if (target.kind == Kind::Folder) {
    write = [place, segmentation, target, told,
             scene = bench.session.scene()](const Progress& progress) {
      *told = write_folder(place, *segmentation, target, *scene, progress);
    };
  } else {
    if (!has_suffix(path, {"h5"}, bench.messages)) return;
    const auto stored =
        target.kind == Kind::Hdf5 ? StoredProbabilities::None : StoredProbabilities::All;
    write = [place, segmentation, stored,
             source = bench.session.input()](const Progress& progress) {
      write_segmentation(place, *segmentation, source, stored, progress);
    };
  }
  write_labels_in_background(
      bench, segment, path, write,
      [bench, told, path, is_whole = target.kind != Kind::Picture,
       scene = bench.session.generation(), labeling = bench.session.labels().labeling] {
        if (is_whole) bench.session.mark_labels_saved(scene, labeling);
        if (!told->empty()) bench.messages.hint(QString("%1: %2").arg(path, finding_words(*told)));
      });
}

}  // namespace episcope

#include "label_exchange.moc"
#include "moc_label_exchange.cpp"
