// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/brush.h"
#include "app/gui/shell/jobs.h"
#include "app/session/annotation_journal.h"
#include "app/session/session.h"

#include <QObject>
#include <QString>

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace episcope {

/// Document of an open scene, with its journal and state.
struct EditedDocument {
  std::uint64_t scene = 0;  ///< OpenScene::id.
  std::filesystem::path journal;
  std::uint64_t state = 0;         ///< AnnotationDocument::state.
  std::filesystem::path stored{};  ///< The file of a project that holds it now.
};

/// Annotation documents of the open light fields, one of them shown. Creates and changes it, keeps
/// its journal and reports changes. Everything that shows, saves or learns from scribbles listens
/// to it.
class DocumentController : public QObject {
  Q_OBJECT

 public:
  explicit DocumentController(Session& session, QObject* parent);
  ~DocumentController() override;

  /// Folder of journals, initially the user's own; empty = no journals.
  void setJournalFolder(std::filesystem::path folder) { journal_folder_ = std::move(folder); }
  [[nodiscard]] const std::filesystem::path& journalFolder() const { return journal_folder_; }

  /// Null without a light field, or before its document exists.
  [[nodiscard]] const AnnotationDocument* document() const;
  /// Those of the document; none without one.
  [[nodiscard]] const LabelSet& labels() const;
  /// Whether the document holds all scribbles of the light field's own files; if not, those must
  /// not be overwritten.
  [[nodiscard]] bool isWhole() const { return now_.is_whole; }
  [[nodiscard]] bool hasUnsavedChanges() const { return isCurrent() && now_.has_unsaved_changes(); }
  /// Whether the last changes are only in a project, not in the file of scribbles.
  [[nodiscard]] bool isInProjectOnly() const;
  /// File that it was last saved to; empty if none.
  [[nodiscard]] std::string file() const;
  /// Replaces the document and ends its journal. `is_whole` and `file` as above. Returns whether
  /// the new one has a journal.
  bool replace(AnnotationDocument document, bool is_whole, const std::string& file);
  /// Notes that a state of a scene's document was written to a file; later strokes remain unsaved.
  void noteSaved(std::uint64_t scene, std::uint64_t state, const std::string& file);
  /// Lets the current changes be dropped with the document.
  void discardChanges();
  void discardAll();
  /// Open scenes (OpenScene::id) whose documents have changes that no file holds.
  [[nodiscard]] std::vector<std::uint64_t> unsavedScenes() const;
  /// Edited documents of open scenes, with journals and current states.
  [[nodiscard]] std::vector<EditedDocument> editedDocuments() const;
  /// Notes that a project holds these states.
  void noteKept(const std::vector<EditedDocument>& documents);
  /// Adds recovered scribbles to a scene that is not shown. `stored`: project file that holds them,
  /// or empty. Returns whether they have a journal again.
  bool bring(std::uint64_t scene, RecoveredAnnotation found, std::filesystem::path stored);

  /// Applies an edit; reports what it throws as a problem. Returns whether the document changed.
  bool edit(const std::function<void(AnnotationDocument&)>& change);
  void undo() { go(&AnnotationDocument::undo); }
  void redo() { go(&AnnotationDocument::redo); }

  /// Begins a stroke on one view, which lasts until it is ended or cancelled. False if it cannot
  /// begin.
  bool beginStroke(ViewIndex view, const PaintStyle& style, StrokePoint at);
  void extendStroke(StrokePoint at);
  void endStroke();
  void cancelStroke();
  [[nodiscard]] bool isStroking() const { return stroke_ != nullptr; }

 signals:
  /// Another document is shown, or none.
  void replaced();
  /// A stroke changed pixels of a view.
  void painted(episcope::ViewIndex view, const episcope::PixelRect& rect);
  /// The history moved a step. Rectangles may cover more than the change.
  void changed(const episcope::DocumentChange& change);
  /// Undo or redo moved the history over `edit`; editors show the place.
  void steppedBack(const episcope::DocumentChange& change, const episcope::Edit& edit,
                   bool is_undo);
  void unsavedChanged(bool has_unsaved_changes);
  /// Problem as a sentence for the user.
  void problem(const QString& sentence);
  /// The scribbles of the light field that is shown cannot be used.
  void finding(const QString& sentence);

 private:
  /// A document that is open.
  struct Open {
    std::unique_ptr<Annotation> annotation;
    bool is_whole = true;
    std::filesystem::path stored{};  ///< The file of a project that held it last.
    std::optional<std::uint64_t> discarded_state{};
    std::optional<std::uint64_t> project_state{};  ///< State held by a project only.
    void note_kept(const EditedDocument& kept);
    [[nodiscard]] bool has_unsaved_changes() const;
  };

  void update(Parts parts);
  void openDocument();
  void leaveDocument();
  void leaveClosed();
  /// Takes over the document kept for the shown scene; false if there is none.
  bool takeAside();
  void beginHash();
  /// Closes a document. A journal with unsaved changes stays, to be offered at the next start.
  static void finish(Open& open);
  void setDocument(AnnotationDocument document, bool is_whole, const std::string& file);
  void go(DocumentChange (AnnotationDocument::*step)());
  void markSaved(Open& open, std::uint64_t state);
  /// Document of a scene that is not shown; null if there is none.
  [[nodiscard]] Open* findAside(std::uint64_t scene);
  /// Ensures that the next strokes survive a crash; returns whether they do.
  bool keepJournal();
  bool keepJournal(Open& open);
  void tell(const DocumentChange& change);
  void tellUnsaved();
  /// Runs a change and reports what it throws. Abandons a failing journal, but keeps strokes stored
  /// in a project there.
  void run(const std::function<void()>& change) { run(now_, change); }
  void run(Open& open, const std::function<void()>& change);
  [[nodiscard]] std::uint64_t sceneOf(const Open& open) const;
  [[nodiscard]] DocumentChange everything() const;
  [[nodiscard]] bool isCurrent() const;

  Session& session_;
  std::filesystem::path journal_folder_;
  Open now_;
  std::map<std::uint64_t, Open> aside_;  // by scene
  std::uint64_t generation_ = 0;         // of the scene that `now_` belongs to
  std::uint64_t sample_hash_ = 0;        // of the light field; 0 = not known yet
  LatestJob hash_job_;
  std::unique_ptr<Stroke> stroke_;
  ViewIndex stroke_view_;
  PixelRect stroke_rect_;
  std::optional<std::uint64_t> written_state_;  // noted while a stroke was under way
  bool was_unsaved_ = false;
};

/// The current label of the document, used to paint and for its probability.
class LabelChoice : public QObject {
  Q_OBJECT

 public:
  LabelChoice(DocumentController& document, QObject* parent);

  /// Id of the current label; 0 without labels.
  [[nodiscard]] int current() const { return current_; }
  /// The current label; null without labels.
  [[nodiscard]] const LabelInfo* info() const;
  /// Name for a label to add, in the language of the window.
  [[nodiscard]] std::string newName() const;
  /// Returns whether the label exists.
  bool choose(int id);
  void chooseNext();
  /// Returns to the previous label.
  void swap() {
    if (former_ != 0) choose(former_);
  }

  /// Offers a region that can be given a label by `give(id)`, and the label that it has; an empty
  /// function takes the offer back.
  void offerRegion(int label, std::function<void(int)> give);
  [[nodiscard]] bool hasRegion() const { return give_ != nullptr; }
  /// Gives the region a label, or the one that it has. Takes the offer back.
  void giveRegion(int id);
  void acceptRegion() { giveRegion(region_label_); }

 signals:
  /// A region was offered, or no longer is.
  void regionChanged();
  /// Another label is current, or its name or color changed.
  void changed();
  /// What was painted with label `from` has label `to` now: it was merged, or has another number.
  void relabeled(int from, int to);

 private:
  void followDocument();

  DocumentController& document_;
  int current_ = 0;
  int former_ = 0;
  int region_label_ = 0;
  std::function<void(int)> give_;
};

}  // namespace episcope
