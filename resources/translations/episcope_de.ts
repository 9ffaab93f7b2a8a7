<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de_DE" sourcelanguage="en">
<context>
    <name>episcope::AnnotateController</name>
    <message>
        <source>Annotate</source>
        <translation>Annotieren</translation>
    </message>
    <message>
        <source>Annotate tab</source>
        <translation>Reiter Annotieren</translation>
    </message>
    <message>
        <source>Shows the labels and painting tools</source>
        <translation>Zeigt die Labels und die Malwerkzeuge</translation>
    </message>
    <message>
        <source>stroke</source>
        <translation>Strich</translation>
    </message>
    <message>
        <source>erasing</source>
        <translation>Radieren</translation>
    </message>
    <message>
        <source>fill</source>
        <translation>Füllung</translation>
    </message>
    <message>
        <source>new label</source>
        <translation>neues Label</translation>
    </message>
    <message>
        <source>label name</source>
        <translation>Name des Labels</translation>
    </message>
    <message>
        <source>label removal</source>
        <translation>Entfernen des Labels</translation>
    </message>
    <message>
        <source>import</source>
        <translation>Import</translation>
    </message>
    <message>
        <source>smooth boundaries</source>
        <translation>Glätten der Grenzen</translation>
    </message>
    <message>
        <source>polygon</source>
        <translation>Polygon</translation>
    </message>
    <message>
        <source>lasso</source>
        <translation>Lasso</translation>
    </message>
    <message>
        <source>Switches between painting labels and browsing</source>
        <translation>Wechselt zwischen Malen und Betrachten</translation>
    </message>
    <message>
        <source>Ctrl+B</source>
        <translation>Ctrl+B</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Rückgängig</translation>
    </message>
    <message>
        <source>Undoes the last stroke or change of labels, on whichever view it was made</source>
        <translation>Nimmt den letzten Strich oder die letzte Änderung der Labels zurück, gleich in welcher Ansicht</translation>
    </message>
    <message>
        <source>Ctrl+Z</source>
        <translation>Ctrl+Z</translation>
    </message>
    <message>
        <source>Undo %1</source>
        <translation>Rückgängig: %1</translation>
    </message>
    <message>
        <source>Redo</source>
        <translation>Wiederherstellen</translation>
    </message>
    <message>
        <source>Redoes the last undone change</source>
        <translation>Stellt die zuletzt zurückgenommene Änderung wieder her</translation>
    </message>
    <message>
        <source>Ctrl+Y</source>
        <translation>Ctrl+Y</translation>
    </message>
    <message>
        <source>Ctrl+Shift+Z</source>
        <translation>Ctrl+Shift+Z</translation>
    </message>
    <message>
        <source>Redo %1</source>
        <translation>Wiederherstellen: %1</translation>
    </message>
    <message>
        <source>Brush</source>
        <translation>Pinsel</translation>
    </message>
    <message>
        <source>Paints the current label; the right button erases</source>
        <translation>Malt das aktuelle Label; die rechte Maustaste radiert</translation>
    </message>
    <message>
        <source>Eraser</source>
        <translation>Radierer</translation>
    </message>
    <message>
        <source>Erases what is painted</source>
        <translation>Radiert Gemaltes</translation>
    </message>
    <message>
        <source>Fill</source>
        <translation>Füllen</translation>
    </message>
    <message>
        <source>Fills a region up to its edges; the right button clears it</source>
        <translation>Füllt ein Gebiet bis zu seinen Kanten; die rechte Maustaste leert es</translation>
    </message>
    <message>
        <source>Polygon</source>
        <translation>Polygon</translation>
    </message>
    <message>
        <source>Paints the inside of a polygon: click its corners, then double-click or press Return; begin with the right button to erase</source>
        <translation>Malt das Innere eines Polygons: die Ecken anklicken, dann doppelklicken oder Eingabe drücken; mit der rechten Maustaste begonnen, radiert es</translation>
    </message>
    <message>
        <source>Lasso</source>
        <translation>Lasso</translation>
    </message>
    <message>
        <source>Paints the region that a drag encloses; the right button erases it</source>
        <translation>Malt, was beim Ziehen umrundet wird; die rechte Maustaste radiert es</translation>
    </message>
    <message>
        <source>Pick label</source>
        <translation>Label aufnehmen</translation>
    </message>
    <message>
        <source>Selects the label under the cursor</source>
        <translation>Wählt das Label unter dem Mauszeiger</translation>
    </message>
    <message>
        <source>Removes the last corner of the polygon</source>
        <translation>Entfernt die zuletzt gesetzte Ecke des Polygons</translation>
    </message>
    <message>
        <source>Larger brush</source>
        <translation>Größerer Pinsel</translation>
    </message>
    <message>
        <source>Enlarges the brush, or the eraser while it is in use</source>
        <translation>Vergrößert den Pinsel oder den Radierer, wenn er in Gebrauch ist</translation>
    </message>
    <message>
        <source>Smaller brush</source>
        <translation>Kleinerer Pinsel</translation>
    </message>
    <message>
        <source>Shrinks the brush, or the eraser while it is in use</source>
        <translation>Verkleinert den Pinsel oder den Radierer, wenn er in Gebrauch ist</translation>
    </message>
    <message>
        <source>Protect other labels</source>
        <translation>Andere Labels schützen</translation>
    </message>
    <message>
        <source>Paints only unpainted pixels and erases only the current label, as holding Shift does</source>
        <translation>Malt nur auf unbemalte Pixel und radiert nur das aktuelle Label, wie mit gehaltener Umschalttaste</translation>
    </message>
    <message>
        <source> and </source>
        <translation> und </translation>
    </message>
    <message>
        <source>“%1” is locked: unlock it to paint it, or choose another label.</source>
        <translation>„%1“ ist gesperrt: zum Malen entsperren oder ein anderes Label wählen.</translation>
    </message>
    <message>
        <source>label color</source>
        <translation>Farbe des Labels</translation>
    </message>
    <message>
        <source>The polygon belongs to view v %1, u %2: go there to continue it. Return closes it, Esc ends it.</source>
        <translation>Das Polygon gehört zu Ansicht v %1, u %2: dort weiterzeichnen. Eingabe schließt es, Esc beendet es.</translation>
    </message>
    <message>
        <source>Nothing is painted or segmented here.</source>
        <translation>Hier ist nichts gemalt oder segmentiert.</translation>
    </message>
    <message>
        <source>merging of labels</source>
        <translation>Verbinden von Labels</translation>
    </message>
    <message>
        <source>Remove the last corner</source>
        <translation>Letzte Ecke entfernen</translation>
    </message>
    <message>
        <source>Paint</source>
        <translation>Malen</translation>
    </message>
    <message>
        <source>The wand is ready.</source>
        <translation>Der Zauberstab ist bereit.</translation>
    </message>
    <message>
        <source>The wand gathers the rays of all views …</source>
        <translation>Der Zauberstab fasst die Strahlen aller Ansichten zusammen …</translation>
    </message>
    <message>
        <source>The wand follows rays by disparity, which is being estimated …</source>
        <translation>Der Zauberstab folgt Strahlen nach der Disparität, die gerade geschätzt wird …</translation>
    </message>
    <message>
        <source>The wand needs the disparity of all views: run a method in the Estimate tab.</source>
        <translation>Der Zauberstab braucht die Disparität aller Ansichten: eine Methode im Reiter Schätzen starten.</translation>
    </message>
    <message>
        <source>label number</source>
        <translation>Nummer des Labels</translation>
    </message>
    <message>
        <source>order of labels</source>
        <translation>Reihenfolge der Labels</translation>
    </message>
    <message>
        <source>Wand, all views</source>
        <translation>Zauberstab, alle Ansichten</translation>
    </message>
    <message>
        <source>Fills a region in all views: like colors on one surface; the right button clears it</source>
        <translation>Füllt ein Gebiet in allen Ansichten: ähnliche Farben auf einer Fläche; die rechte Maustaste leert es</translation>
    </message>
    <message>
        <source>Shift+F</source>
        <translation>Shift+F</translation>
    </message>
    <message>
        <source>Close the polygon, or accept the region</source>
        <translation>Polygon schließen oder Gebiet annehmen</translation>
    </message>
    <message>
        <source>Paints the inside of the polygon being drawn; without one, paints the marked region in doubt with the label that it has, else what the fill or the wand shows under the cursor</source>
        <translation>Malt das Innere des begonnenen Polygons; ohne eines das markierte zweifelhafte Gebiet mit seinem Label, sonst was Füllung oder Zauberstab unter dem Zeiger zeigen</translation>
    </message>
    <message>
        <source>import of a segmentation</source>
        <translation>Import einer Segmentierung</translation>
    </message>
</context>
<context>
    <name>episcope::AnnotationBar</name>
    <message>
        <source>Propagate to all views by</source>
        <translation>In alle Ansichten übertragen mit</translation>
    </message>
    <message>
        <source>the shown estimate</source>
        <translation>der angezeigten Schätzung</translation>
    </message>
    <message>
        <source>the ground truth</source>
        <translation>der Referenz</translation>
    </message>
    <message>
        <source>Disparity along which scribbles are propagated</source>
        <translation>Disparität, mit der Striche übertragen werden</translation>
    </message>
    <message>
        <source>Shows the scribbles of every view on all others, as stripes: propagated along rays, except where they are occluded. They never replace what you painted.</source>
        <translation>Zeigt die Striche jeder Ansicht gestreift auf allen anderen: entlang der Strahlen übertragen, außer wo sie verdeckt sind. Sie ersetzen nie, was gemalt wurde.</translation>
    </message>
</context>
<context>
    <name>episcope::AnnotationFiles</name>
    <message>
        <source>Save scribbles</source>
        <translation>Striche speichern</translation>
    </message>
    <message>
        <source>Saves labels and scribbles, beside the light field if that folder is writable</source>
        <translation>Speichert Labels und Striche, neben dem Lichtfeld, falls dessen Ordner beschreibbar ist</translation>
    </message>
    <message>
        <source>Save scribbles as…</source>
        <translation>Striche speichern unter…</translation>
    </message>
    <message>
        <source>Saves labels and scribbles to another file</source>
        <translation>Speichert Labels und Striche in einer anderen Datei</translation>
    </message>
    <message>
        <source>Ctrl+Shift+S</source>
        <translation>Ctrl+Shift+S</translation>
    </message>
    <message>
        <source>Compare with true labels…</source>
        <translation>Mit wahren Labels vergleichen…</translation>
    </message>
    <message>
        <source>Compares the segmentation with the GT_LABELS of another file</source>
        <translation>Vergleicht die Segmentierung mit den GT_LABELS einer anderen Datei</translation>
    </message>
    <message>
        <source>Writes a PNG image of each painted view</source>
        <translation>Schreibt von jeder bemalten Ansicht ein PNG-Bild</translation>
    </message>
    <message>
        <source>no file yet</source>
        <translation>noch keine Datei</translation>
    </message>
    <message>
        <source>saving …</source>
        <translation>wird gespeichert …</translation>
    </message>
    <message>
        <source>%1 · not saved</source>
        <translation>%1 · nicht gespeichert</translation>
    </message>
    <message>
        <source>Archive labels (*.h5)</source>
        <translation>Labels des Archivs (*.h5)</translation>
    </message>
    <message>
        <source>Reading %1</source>
        <translation>Lesen von %1</translation>
    </message>
    <message>
        <source>Reloaded: %1</source>
        <translation>Neu geladen: %1</translation>
    </message>
    <message>
        <source>Saving %1</source>
        <translation>Speichern von %1</translation>
    </message>
    <message>
        <source>Nothing is painted yet: there are no scribbles to export.</source>
        <translation>Noch ist nichts gemalt: es gibt keine Striche zu exportieren.</translation>
    </message>
    <message>
        <source>Folder for the images of the painted views</source>
        <translation>Ordner für die Bilder der bemalten Ansichten</translation>
    </message>
    <message>
        <source>Writing scribble images</source>
        <translation>Schreiben der Bilder von Strichen</translation>
    </message>
    <message>
        <source>Compare with true labels</source>
        <translation>Mit wahren Labels vergleichen</translation>
    </message>
    <message>
        <source>Archive labels (*.h5 *.hdf5);;All files (*)</source>
        <translation>Labels des Archivs (*.h5 *.hdf5);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Labels are now compared with %1</source>
        <translation>Labels werden nun mit %1 verglichen</translation>
    </message>
    <message>
        <source>Unsaved scribbles</source>
        <translation>Nicht gespeicherte Striche</translation>
    </message>
    <message>
        <source>The scribbles on “%1” have not been saved.</source>
        <translation>Die Striche in „%1“ sind nicht gespeichert.</translation>
    </message>
    <message>
        <source>Reloading replaces the open labels and strokes.</source>
        <translation>Neuladen ersetzt die hier geöffneten Labels und Striche.</translation>
    </message>
    <message>
        <source>%1 · in the project only</source>
        <translation>%1 · nur im Projekt</translation>
    </message>
    <message>
        <source>%1 exists. Replace its labels and scribbles? What else it holds stays.</source>
        <translation>%1 gibt es schon. Labels und Striche darin ersetzen? Was die Datei sonst enthält, bleibt.</translation>
    </message>
    <message>
        <source>Scribbles as images…</source>
        <translation>Striche als Bilder…</translation>
    </message>
    <message>
        <source>%1 cannot be written: choose another place for labels and scribbles.</source>
        <translation>%1 lässt sich nicht schreiben: einen anderen Ort für Labels und Striche wählen.</translation>
    </message>
    <message>
        <source>Nothing is painted yet: there are no scribbles to save.</source>
        <translation>Noch ist nichts gemalt: Es gibt keine Striche zu speichern.</translation>
    </message>
</context>
<context>
    <name>episcope::Autosave</name>
    <message>
        <source>Results cannot be kept for a crash: %1</source>
        <translation>Ergebnisse können nicht für den Fall eines Absturzes gesichert werden: %1</translation>
    </message>
</context>
<context>
    <name>episcope::BatchDialog</name>
    <message>
        <source>Run on several light fields</source>
        <translation>Auf mehrere Lichtfelder anwenden</translation>
    </message>
    <message>
        <source>Methods</source>
        <translation>Verfahren</translation>
    </message>
    <message>
        <source>Light fields</source>
        <translation>Lichtfelder</translation>
    </message>
    <message>
        <source>Run (%1)</source>
        <translation>Starten (%1)</translation>
    </message>
</context>
<context>
    <name>episcope::BrowseController</name>
    <message>
        <source>%1, to the end</source>
        <translation>%1, bis ans Ende</translation>
    </message>
    <message>
        <source>%1, at the end of the grid</source>
        <translation>%1, am Ende des Rasters</translation>
    </message>
    <message>
        <source>View to the left</source>
        <translation>Ansicht links</translation>
    </message>
    <message>
        <source>Shows the view to the left</source>
        <translation>Zeigt die Ansicht links daneben</translation>
    </message>
    <message>
        <source>View to the right</source>
        <translation>Ansicht rechts</translation>
    </message>
    <message>
        <source>Shows the view to the right</source>
        <translation>Zeigt die Ansicht rechts daneben</translation>
    </message>
    <message>
        <source>View above</source>
        <translation>Ansicht darüber</translation>
    </message>
    <message>
        <source>Shows the view above</source>
        <translation>Zeigt die Ansicht darüber</translation>
    </message>
    <message>
        <source>View below</source>
        <translation>Ansicht darunter</translation>
    </message>
    <message>
        <source>Shows the view below</source>
        <translation>Zeigt die Ansicht darunter</translation>
    </message>
    <message>
        <source>Shows the view in the middle of the grid</source>
        <translation>Zeigt die Ansicht in der Mitte des Rasters</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>Abspielen</translation>
    </message>
    <message>
        <source>Plays the views one after the other, or pauses</source>
        <translation>Spielt die Ansichten nacheinander ab oder hält an</translation>
    </message>
    <message>
        <source>Zoom in</source>
        <translation>Vergrößern</translation>
    </message>
    <message>
        <source>Enlarges the picture</source>
        <translation>Vergrößert das Bild</translation>
    </message>
    <message>
        <source>Ctrl++</source>
        <translation>Ctrl++</translation>
    </message>
    <message>
        <source>Zoom out</source>
        <translation>Verkleinern</translation>
    </message>
    <message>
        <source>Shrinks the picture</source>
        <translation>Verkleinert das Bild</translation>
    </message>
    <message>
        <source>Ctrl+-</source>
        <translation>Ctrl+-</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>Einpassen</translation>
    </message>
    <message>
        <source>Fits the whole picture into its pane</source>
        <translation>Passt das ganze Bild in seinen Platz ein</translation>
    </message>
    <message>
        <source>100 %</source>
        <translation>100 %</translation>
    </message>
    <message>
        <source>Shows each image pixel as one screen pixel</source>
        <translation>Zeigt jedes Bildpixel als ein Bildschirmpixel</translation>
    </message>
    <message>
        <source>Ctrl+0</source>
        <translation>Ctrl+0</translation>
    </message>
    <message>
        <source>Focus nearer</source>
        <translation>Fokus näher</translation>
    </message>
    <message>
        <source>Moves the focus plane to larger disparities</source>
        <translation>Verschiebt die Fokusebene zu größeren Disparitäten</translation>
    </message>
    <message>
        <source>Ctrl+Alt+Up</source>
        <translation>Ctrl+Alt+Up</translation>
    </message>
    <message>
        <source>Focus farther</source>
        <translation>Fokus ferner</translation>
    </message>
    <message>
        <source>Moves the focus plane to smaller disparities</source>
        <translation>Verschiebt die Fokusebene zu kleineren Disparitäten</translation>
    </message>
    <message>
        <source>Ctrl+Alt+Down</source>
        <translation>Ctrl+Alt+Down</translation>
    </message>
    <message>
        <source>Focus at zero</source>
        <translation>Fokus auf null</translation>
    </message>
    <message>
        <source>Moves the focus plane back to zero disparity</source>
        <translation>Setzt die Fokusebene auf Disparität null zurück</translation>
    </message>
    <message>
        <source>Ctrl+Alt+0</source>
        <translation>Ctrl+Alt+0</translation>
    </message>
    <message>
        <source>Refocus the view</source>
        <translation>Ansicht refokussieren</translation>
    </message>
    <message>
        <source>Refocuses the view too, as the mean of all views at the focus plane; otherwise only the EPIs are sheared</source>
        <translation>Refokussiert auch die Ansicht, als Mittel aller Ansichten in der Fokusebene; sonst werden nur die EPIs geschert</translation>
    </message>
    <message>
        <source>Center view</source>
        <translation>Mittlere Ansicht</translation>
    </message>
    <message>
        <source>The disparity of this pixel cannot be found by itself: run a method first, or move the slider.</source>
        <translation>Die Disparität dieses Pixels lässt sich für sich allein nicht finden: zuerst ein Verfahren starten oder den Regler bewegen.</translation>
    </message>
    <message>
        <source>Focus here</source>
        <translation>Hier fokussieren</translation>
    </message>
    <message>
        <source>Measure here</source>
        <translation>Hier messen</translation>
    </message>
    <message>
        <source>Drag along a line of an EPI to measure its disparity.</source>
        <translation>Entlang einer Linie eines EPIs ziehen, um deren Disparität zu messen.</translation>
    </message>
    <message>
        <source>Drag along a line of an EPI to measure its disparity; %1 keeps it.</source>
        <translation>Entlang einer Linie eines EPIs ziehen, um deren Disparität zu messen; %1 behält sie.</translation>
    </message>
    <message>
        <source>Save picture…</source>
        <translation>Bild speichern…</translation>
    </message>
    <message>
        <source>Save map…</source>
        <translation>Karte speichern…</translation>
    </message>
</context>
<context>
    <name>episcope::BrushPanel</name>
    <message>
        <source>Protect other labels</source>
        <translation>Andere Labels schützen</translation>
    </message>
    <message>
        <source>Brush</source>
        <translation>Pinsel</translation>
    </message>
    <message>
        <source>Eraser</source>
        <translation>Radierer</translation>
    </message>
    <message>
        <source>Opacity of painted labels</source>
        <translation>Deckkraft des Gemalten</translation>
    </message>
    <message>
        <source>Opacity</source>
        <translation>Deckkraft</translation>
    </message>
    <message>
        <source>The brush paints only unpainted pixels, and the eraser erases only the current label. Hold Shift for a single stroke of this kind.</source>
        <translation>Der Pinsel bemalt nur unbemalte Pixel, der Radierer entfernt nur das aktuelle Label. Dasselbe bewirkt die gehaltene Umschalttaste.</translation>
    </message>
    <message>
        <source> px</source>
        <translation> px</translation>
    </message>
    <message>
        <source>its segment</source>
        <translation>sein Segment</translation>
    </message>
    <message>
        <source>Fill</source>
        <translation>Füllen</translation>
    </message>
    <message>
        <source>Diameter in pixels of the view (%1)</source>
        <translation>Durchmesser in Pixeln der Ansicht (%1)</translation>
    </message>
    <message>
        <source>Ctrl+Shift+wheel</source>
        <translation>Strg+Umschalt+Mausrad</translation>
    </message>
    <message>
        <source>%1, or Ctrl+Shift+wheel</source>
        <translation>%1 oder Strg+Umschalt+Mausrad</translation>
    </message>
    <message>
        <source>like colors</source>
        <translation>ähnliche Farben</translation>
    </message>
    <message>
        <source>Limits of a fill: pixels of like color on one surface, or the segment of the current segmentation</source>
        <translation>Grenzen einer Füllung: Pixel ähnlicher Farbe auf einer Fläche oder das Segment der aktuellen Segmentierung</translation>
    </message>
    <message>
        <source> × noise</source>
        <translation> × Rauschen</translation>
    </message>
    <message>
        <source>How much colors may differ from the color under the cursor, in units of what neighboring pixels of this view differ by. Drag to the right or left while filling to change it.</source>
        <translation>Wie weit Farben von der Farbe unter dem Zeiger abweichen dürfen, gemessen am Unterschied benachbarter Pixel dieser Ansicht. Beim Füllen nach rechts oder links ziehen ändert es.</translation>
    </message>
</context>
<context>
    <name>episcope::BuiltinDialog</name>
    <message>
        <source>Built-in scenes</source>
        <translation>Eingebaute Szenen</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Öffnen</translation>
    </message>
    <message>
        <source>On a command line: %1</source>
        <translation>Auf der Befehlszeile: %1</translation>
    </message>
</context>
<context>
    <name>episcope::CaptureController</name>
    <message>
        <source>Capture</source>
        <translation>Aufnahme</translation>
    </message>
    <message>
        <source>Capture tab</source>
        <translation>Reiter Aufnahme</translation>
    </message>
    <message>
        <source>Makes ground truth from a mesh</source>
        <translation>Erzeugt Referenzdaten aus einem Dreiecksnetz</translation>
    </message>
    <message>
        <source>Open a mesh</source>
        <translation>Netz öffnen</translation>
    </message>
    <message>
        <source>Meshes (*.ply *.obj *.stl)</source>
        <translation>Dreiecksnetze (*.ply *.obj *.stl)</translation>
    </message>
    <message>
        <source>Import pairs</source>
        <translation>Punktpaare importieren</translation>
    </message>
    <message>
        <source>Pairs (*.csv)</source>
        <translation>Punktpaare (*.csv)</translation>
    </message>
    <message>
        <source>Export pairs</source>
        <translation>Punktpaare exportieren</translation>
    </message>
    <message>
        <source>Save the pose</source>
        <translation>Pose speichern</translation>
    </message>
    <message>
        <source>Pose (*.json)</source>
        <translation>Pose (*.json)</translation>
    </message>
    <message>
        <source>Write the light field with its ground truth</source>
        <translation>Lichtfeld mit seiner Referenz schreiben</translation>
    </message>
    <message>
        <source>Light field (*.h5)</source>
        <translation>Lichtfeld (*.h5)</translation>
    </message>
    <message>
        <source>%1 · %2 faces</source>
        <translation>%1 · %2 Dreiecke</translation>
    </message>
    <message>
        <source>corner</source>
        <translation>Ecke</translation>
    </message>
    <message>
        <source>blob</source>
        <translation>Fleck</translation>
    </message>
    <message>
        <source>%1 (no mark beside it)</source>
        <translation>%1 (keine Marke in der Nähe)</translation>
    </message>
    <message>
        <source>%1 of at least 4 pairs; 10 are better.</source>
        <translation>%1 von mindestens 4 Punktpaaren; 10 sind besser.</translation>
    </message>
    <message>
        <source>Mean reprojection error %1 px; depth to ± %2 (unit of the mesh)</source>
        <translation>Mittlerer Rückprojektionsfehler %1 px; Tiefe auf ± %2 (Einheit des Netzes)</translation>
    </message>
    <message>
        <source>, ± %1 px of disparity</source>
        <translation>, ± %1 px Disparität</translation>
    </message>
    <message>
        <source>%1 is being read…</source>
        <translation>%1 wird gelesen…</translation>
    </message>
    <message>
        <source>%1 cannot be read</source>
        <translation>%1 kann nicht gelesen werden</translation>
    </message>
    <message>
        <source>%1 was dropped: its light field was closed meanwhile.</source>
        <translation>%1 wurde verworfen: Das Lichtfeld dazu wurde inzwischen geschlossen.</translation>
    </message>
    <message>
        <source>%1 was not read</source>
        <translation>%1 wurde nicht gelesen</translation>
    </message>
    <message>
        <source>This light field does not tell its focal length and center in pixels, which a pose needs. Rectify photographs with their calibrated lens; pairs are carried over.</source>
        <translation>Dieses Lichtfeld nennt weder Brennweite noch Bildmitte in Pixeln, die für eine Pose nötig sind. Die Fotos mit ihrem kalibrierten Objektiv rektifizieren; Punktpaare werden übernommen.</translation>
    </message>
    <message>
        <source>go to the center view (Home)</source>
        <translation>zur mittleren Ansicht gehen (Pos1)</translation>
    </message>
    <message>
        <source>Photographs</source>
        <translation>Fotos</translation>
    </message>
    <message>
        <source>Raw picture</source>
        <translation>Rohbild</translation>
    </message>
</context>
<context>
    <name>episcope::CaptureFiles</name>
    <message>
        <source>%1 exists already; name a new file, so that no light field is lost</source>
        <translation>%1 gibt es schon; eine neue Datei angeben, damit kein Lichtfeld verloren geht</translation>
    </message>
</context>
<context>
    <name>episcope::CaptureObjects</name>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Removes this object with its pairs</source>
        <translation>Entfernt dieses Objekt mit seinen Punktpaaren</translation>
    </message>
    <message>
        <source>Objects</source>
        <translation>Objekte</translation>
    </message>
    <message>
        <source>The object whose pairs are picked; type to rename it. Each has its own mesh and pose.</source>
        <translation>Das Objekt, dessen Punktpaare gewählt werden; zum Umbenennen tippen. Jedes hat sein eigenes Netz und seine eigene Pose.</translation>
    </message>
    <message>
        <source>Add…</source>
        <translation>Hinzufügen…</translation>
    </message>
    <message>
        <source>Adds one more object, with a mesh of its own</source>
        <translation>Fügt ein weiteres Objekt mit eigenem Netz hinzu</translation>
    </message>
    <message>
        <source>Open mesh…</source>
        <translation>Netz öffnen…</translation>
    </message>
    <message>
        <source>A scan of an object in the light field: PLY, OBJ or STL</source>
        <translation>Ein Scan dessen, was das Lichtfeld zeigt: PLY, OBJ oder STL</translation>
    </message>
    <message>
        <source>No mesh</source>
        <translation>Kein Netz</translation>
    </message>
</context>
<context>
    <name>episcope::CapturePanel</name>
    <message>
        <source>Snap</source>
        <translation>Einrasten</translation>
    </message>
    <message>
        <source>Add pair</source>
        <translation>Paar hinzufügen</translation>
    </message>
    <message>
        <source>The cross-hair and the marked point of the mesh are the same point</source>
        <translation>Das Fadenkreuz und der markierte Punkt des Netzes sind derselbe Punkt</translation>
    </message>
    <message>
        <source>Picked pairs</source>
        <translation>Gewählte Punktpaare</translation>
    </message>
    <message>
        <source>Pair</source>
        <translation>Paar</translation>
    </message>
    <message>
        <source>View</source>
        <translation>Ansicht</translation>
    </message>
    <message>
        <source>Mesh</source>
        <translation>Netz</translation>
    </message>
    <message>
        <source>Off by</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Removes the chosen pairs</source>
        <translation>Entfernt die ausgewählten Paare</translation>
    </message>
    <message>
        <source>Import…</source>
        <translation>Importieren…</translation>
    </message>
    <message>
        <source>Adds pairs from CSV</source>
        <translation>Fügt Paare aus einer CSV-Datei hinzu</translation>
    </message>
    <message>
        <source>Export…</source>
        <translation>Exportieren…</translation>
    </message>
    <message>
        <source>Writes all pairs as CSV</source>
        <translation>Schreibt alle Paare als CSV</translation>
    </message>
    <message>
        <source>Show over view</source>
        <translation>Überlagern</translation>
    </message>
    <message>
        <source>Adds the disparity of the mesh to the results, to be drawn over the view, wiped and compared</source>
        <translation>Fügt die Disparität des Netzes den Ergebnissen hinzu, um sie über die Ansicht zu legen, zu wischen und zu vergleichen</translation>
    </message>
    <message>
        <source>Save pose…</source>
        <translation>Pose speichern…</translation>
    </message>
    <message>
        <source>Writes pose, pairs and errors as JSON</source>
        <translation>Schreibt Pose, Paare und Fehler als JSON</translation>
    </message>
    <message>
        <source>Write ground truth…</source>
        <translation>Referenz schreiben…</translation>
    </message>
    <message>
        <source>Writes the light field with the depth of the mesh in all views</source>
        <translation>Schreibt das Lichtfeld mit der Tiefe des Netzes in allen Ansichten</translation>
    </message>
    <message>
        <source>%1 px</source>
        <translation>%1 px</translation>
    </message>
    <message>
        <source>%1, wrong?</source>
        <translation>%1, falsch?</translation>
    </message>
    <message>
        <source>View %1 · mesh %2</source>
        <translation>Ansicht %1 · Netz %2</translation>
    </message>
    <message>
        <source>–</source>
        <translation>–</translation>
    </message>
    <message>
        <source>(click a point)</source>
        <translation>(einen Punkt anklicken)</translation>
    </message>
    <message>
        <source>Lock</source>
        <translation>Sperre</translation>
    </message>
    <message>
        <source>A locked pair is trusted: it is neither removed nor treated as a wrong pick</source>
        <translation>Ein gesperrtes Punktpaar ist richtig: Es wird nicht entfernt und nicht für falsch gewählt gehalten</translation>
    </message>
    <message>
        <source>Undo the last change of this tab</source>
        <translation>Die letzte Änderung in diesem Reiter zurücknehmen</translation>
    </message>
    <message>
        <source>Redo the last undone change</source>
        <translation>Die zuletzt zurückgenommene Änderung wiederherstellen</translation>
    </message>
    <message>
        <source>Takes the corner or the center of the blob beside the cross-hair, to a fraction of a pixel</source>
        <translation>Nimmt die Ecke oder die Mitte des Flecks neben dem Fadenkreuz, auf Bruchteile eines Pixels</translation>
    </message>
    <message>
        <source>Open a mesh of an object in the light field. Then set the cross-hair in the center view, click the same point of the mesh here, and add the pair. Four pairs give its pose.

Without a gantry at hand, “Lens” makes a demo to try it with.</source>
        <translation>Ein Dreiecksnetz dessen öffnen, was das Lichtfeld zeigt. Dann das Fadenkreuz in der mittleren Ansicht setzen, hier denselben Punkt des Netzes anklicken und das Paar hinzufügen. Vier Paare ergeben seine Pose.

Ohne Kameraportal erzeugt „Objektiv“ eine Demo zum Ausprobieren.</translation>
    </message>
</context>
<context>
    <name>episcope::ChangedFile</name>
    <message>
        <source>The file has changed</source>
        <translation>Die Datei wurde geändert</translation>
    </message>
    <message>
        <source>Save to another file…</source>
        <translation>In anderer Datei speichern…</translation>
    </message>
    <message>
        <source>Overwrite</source>
        <translation>Überschreiben</translation>
    </message>
    <message>
        <source>Reload</source>
        <translation>Neu laden</translation>
    </message>
    <message>
        <source>Another program has written %1 since it was read or saved here. Saving replaces those changes.</source>
        <translation>Ein anderes Programm hat %1 geschrieben, seit die Datei hier gelesen oder gespeichert wurde. Speichern ersetzt, was dieses Programm schrieb.</translation>
    </message>
</context>
<context>
    <name>episcope::CloudController</name>
    <message>
        <source>3D in place of the view</source>
        <translation>3D anstelle der Ansicht</translation>
    </message>
    <message>
        <source>Shows the 3D view in place of the current view, or moves it back into its tab</source>
        <translation>Zeigt die 3D-Ansicht groß anstelle der Ansicht oder wieder in ihrem Reiter</translation>
    </message>
    <message>
        <source>3D in its own window</source>
        <translation>3D im eigenen Fenster</translation>
    </message>
    <message>
        <source>Detaches the 3D view and its controls into their own window, or docks them again</source>
        <translation>Gibt der 3D-Ansicht mit ihren Bedienelementen ein eigenes Fenster oder holt sie zurück</translation>
    </message>
    <message>
        <source>Shift+F4</source>
        <translation>Shift+F4</translation>
    </message>
    <message>
        <source>Ctrl+Alt+E</source>
        <translation>Ctrl+Alt+E</translation>
    </message>
    <message>
        <source>3D</source>
        <translation>3D</translation>
    </message>
    <message>
        <source>3D tab</source>
        <translation>Reiter 3D</translation>
    </message>
    <message>
        <source>Shows the result in 3D, as points or as a surface</source>
        <translation>Zeigt das Ergebnis in 3D, als Punkte oder als Fläche</translation>
    </message>
    <message>
        <source>The 3D view is shown in place of the view.</source>
        <translation>Die 3D-Ansicht steht anstelle der Ansicht.</translation>
    </message>
    <message>
        <source>Measuring distances …</source>
        <translation>Abstände werden gemessen …</translation>
    </message>
    <message>
        <source>This result has no valid pixels in this view.</source>
        <translation>Dieses Ergebnis hat in dieser Ansicht keine gültigen Pixel.</translation>
    </message>
    <message>
        <source>%1: %2 points</source>
        <translation>%1: %2 Punkte</translation>
    </message>
    <message>
        <source>, in orange and blue</source>
        <translation>, in Orange und Blau</translation>
    </message>
    <message>
        <source>. From its points to the nearest of %1, in units of the scene: mean %2, median %3, 95 % below %4</source>
        <translation>. Von seinen Punkten zum nächsten von %1, in Einheiten der Szene: Mittel %2, Median %3, 95 % unter %4</translation>
    </message>
    <message>
        <source>Save the 3D view</source>
        <translation>Inhalt der 3D-Ansicht speichern</translation>
    </message>
    <message>
        <source>Point cloud or surface (*.ply)</source>
        <translation>Punktwolke oder Fläche (*.ply)</translation>
    </message>
    <message>
        <source>Writes the points or surfaces that the 3D view shows, in their colors, as PLY</source>
        <translation>Schreibt die Punkte oder Flächen der 3D-Ansicht in ihren Farben als PLY</translation>
    </message>
    <message>
        <source>3D view…</source>
        <translation>3D-Ansicht…</translation>
    </message>
</context>
<context>
    <name>episcope::CloudControls</name>
    <message>
        <source>Surface</source>
        <translation>Fläche</translation>
    </message>
    <message>
        <source>Lit</source>
        <translation>Beleuchtet</translation>
    </message>
    <message>
        <source>view</source>
        <translation>Ansicht</translation>
    </message>
    <message>
        <source>disparity</source>
        <translation>Disparität</translation>
    </message>
    <message>
        <source>error</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>labels</source>
        <translation>Labels</translation>
    </message>
    <message>
        <source>distance</source>
        <translation>Abstand</translation>
    </message>
    <message>
        <source>one each</source>
        <translation>je eine</translation>
    </message>
    <message>
        <source>Shown together with the result</source>
        <translation>Was mit dem Ergebnis gezeigt wird</translation>
    </message>
    <message>
        <source>Shown with the result</source>
        <translation>Mit dem Ergebnis gezeigt</translation>
    </message>
    <message>
        <source>nothing else</source>
        <translation>nichts weiter</translation>
    </message>
    <message>
        <source>the ground truth</source>
        <translation>die Referenz</translation>
    </message>
    <message>
        <source>B</source>
        <translation>B</translation>
    </message>
    <message>
        <source>Where the two stand</source>
        <translation>Wo die beiden stehen</translation>
    </message>
    <message>
        <source>Arrangement</source>
        <translation>Anordnung</translation>
    </message>
    <message>
        <source>in one place</source>
        <translation>an einem Ort</translation>
    </message>
    <message>
        <source>side by side</source>
        <translation>nebeneinander</translation>
    </message>
    <message>
        <source>With</source>
        <translation>Mit</translation>
    </message>
    <message>
        <source>Lights the surface from where you look</source>
        <translation>Beleuchtet die Fläche aus der Blickrichtung</translation>
    </message>
    <message>
        <source>Jump at which the surface is cut</source>
        <translation>Sprung, an dem die Fläche geschnitten wird</translation>
    </message>
    <message>
        <source>Points are not joined if their disparities differ by more than this, in px per pixel between them</source>
        <translation>Punkte werden nicht verbunden, wenn ihre Disparitäten um mehr als diesen Wert voneinander abweichen, in px je Pixel Abstand</translation>
    </message>
    <message>
        <source>cut over </source>
        <translation>Schnitt ab </translation>
    </message>
    <message>
        <source> px</source>
        <translation> px</translation>
    </message>
    <message>
        <source>Point size</source>
        <translation>Punktgröße</translation>
    </message>
    <message>
        <source>Size of the points, in pixels</source>
        <translation>Größe der Punkte in Pixeln</translation>
    </message>
    <message>
        <source>Stretch z</source>
        <translation>z strecken</translation>
    </message>
    <message>
        <source>Stretch along the line of sight</source>
        <translation>Streckung entlang der Blickrichtung</translation>
    </message>
    <message>
        <source>Cut nearer than</source>
        <translation>Näheres abschneiden</translation>
    </message>
    <message>
        <source>Hides everything nearer</source>
        <translation>Lässt weg, was näher ist</translation>
    </message>
    <message>
        <source>Cut farther than</source>
        <translation>Ferneres abschneiden</translation>
    </message>
    <message>
        <source>Hides everything farther away</source>
        <translation>Lässt weg, was ferner ist</translation>
    </message>
    <message>
        <source>No stretch and no cut</source>
        <translation>Ohne Streckung und Schnitt</translation>
    </message>
    <message>
        <source>Points</source>
        <translation>Punkte</translation>
    </message>
    <message>
        <source>Near</source>
        <translation>Nah</translation>
    </message>
    <message>
        <source>Far</source>
        <translation>Fern</translation>
    </message>
    <message>
        <source>Color of the points</source>
        <translation>Farbe der Punkte</translation>
    </message>
    <message>
        <source>Color</source>
        <translation>Farbe</translation>
    </message>
    <message>
        <source>Joins neighboring points to a surface, which is cut at jumps</source>
        <translation>Verbindet benachbarte Punkte zu einer Fläche, die an Sprüngen geschnitten wird</translation>
    </message>
    <message>
        <source>Distance of each point to the nearest point of the ground truth or of the other result, in units of the scene</source>
        <translation>Abstand jedes Punkts zum nächsten Punkt der Referenz oder dessen, was mit ihm gezeigt wird, in Einheiten der Szene</translation>
    </message>
</context>
<context>
    <name>episcope::CloudRequests</name>
    <message>
        <source>Run a method: its disparity appears here in 3D.</source>
        <translation>Ein Verfahren ausführen: seine Disparität erscheint hier in 3D.</translation>
    </message>
    <message>
        <source>the ground truth</source>
        <translation>die Referenz</translation>
    </message>
    <message>
        <source>Ground truth</source>
        <translation>Referenz (Ground Truth)</translation>
    </message>
    <message>
        <source>%1 and the ground truth</source>
        <translation>%1 und die Referenz</translation>
    </message>
    <message>
        <source>%1 and %2</source>
        <translation>%1 und %2</translation>
    </message>
    <message>
        <source>%1 [%2]</source>
        <translation>%1 [%2]</translation>
    </message>
    <message>
        <source>distance</source>
        <translation>Abstand</translation>
    </message>
    <message>
        <source>%1 has no map of this view. Go to the center view (Home).</source>
        <translation>%1 hat keine Karte dieser Ansicht. Zur mittleren Ansicht gehen (Pos1).</translation>
    </message>
</context>
<context>
    <name>episcope::CollectionController</name>
    <message>
        <source>%1 frames</source>
        <translation>%1 Einzelbilder</translation>
    </message>
    <message>
        <source>%1 views</source>
        <translation>%1 Ansichten</translation>
    </message>
    <message>
        <source>grey</source>
        <translation>grau</translation>
    </message>
    <message>
        <source>16 bit</source>
        <translation>16 Bit</translation>
    </message>
    <message>
        <source>float</source>
        <translation>Gleitkomma</translation>
    </message>
    <message>
        <source>cannot be opened</source>
        <translation>kann nicht geöffnet werden</translation>
    </message>
    <message>
        <source>1 result</source>
        <translation>1 Ergebnis</translation>
    </message>
    <message>
        <source>%1 results</source>
        <translation>%1 Ergebnisse</translation>
    </message>
    <message>
        <source>Scenes</source>
        <translation>Szenen</translation>
    </message>
    <message>
        <source>Scenes tab</source>
        <translation>Reiter Szenen</translation>
    </message>
    <message>
        <source>Shows the light fields of a folder</source>
        <translation>Zeigt die Lichtfelder eines Ordners</translation>
    </message>
    <message>
        <source>Lists every light field in a folder and in the folders inside</source>
        <translation>Listet alle Lichtfelder eines Ordners und seiner Unterordner auf</translation>
    </message>
    <message>
        <source>Open a folder of light fields</source>
        <translation>Ordner mit Lichtfeldern öffnen</translation>
    </message>
    <message>
        <source>Next scene</source>
        <translation>Nächste Szene</translation>
    </message>
    <message>
        <source>Opens the next light field of the collection</source>
        <translation>Öffnet das nächste Lichtfeld der Sammlung</translation>
    </message>
    <message>
        <source>Previous scene</source>
        <translation>Vorige Szene</translation>
    </message>
    <message>
        <source>Opens the previous light field of the collection</source>
        <translation>Öffnet das vorige Lichtfeld der Sammlung</translation>
    </message>
    <message>
        <source>Listing %1</source>
        <translation>Auflisten von %1</translation>
    </message>
    <message>
        <source>Choose a scene in the list.</source>
        <translation>Wählen Sie eine Szene in der Liste.</translation>
    </message>
    <message>
        <source>Collection…</source>
        <translation>Sammlung…</translation>
    </message>
    <message>
        <source>2013 archive</source>
        <translation>Archiv von 2013</translation>
    </message>
    <message>
        <source>2016 benchmark</source>
        <translation>Benchmark von 2016</translation>
    </message>
    <message>
        <source>images</source>
        <translation>Bilder</translation>
    </message>
    <message>
        <source>views in one picture</source>
        <translation>Ansichten in einem Bild</translation>
    </message>
    <message>
        <source>sequence</source>
        <translation>Folge</translation>
    </message>
    <message>
        <source>pages or film</source>
        <translation>Seiten oder Film</translation>
    </message>
    <message>
        <source>Folder</source>
        <translation>Ordner</translation>
    </message>
</context>
<context>
    <name>episcope::ColorBar</name>
    <message>
        <source>Lower end of the range</source>
        <translation>Unteres Ende des Bereichs</translation>
    </message>
    <message>
        <source>Upper end of the range</source>
        <translation>Oberes Ende des Bereichs</translation>
    </message>
    <message>
        <source>Lock the range: it stays when the result changes</source>
        <translation>Bereich festhalten: er bleibt, wenn das Ergebnis wechselt</translation>
    </message>
    <message>
        <source>Automatic range of the visible values</source>
        <translation>Automatischer Bereich der sichtbaren Werte</translation>
    </message>
    <message>
        <source>Default range of the quantity</source>
        <translation>Standardbereich der Größe</translation>
    </message>
    <message>
        <source>%1 [%2]</source>
        <translation>%1 [%2]</translation>
    </message>
    <message>
        <source>invalid</source>
        <translation>ungültig</translation>
    </message>
    <message>
        <source>Color of pixels without a value</source>
        <translation>Farbe von Pixeln ohne Wert</translation>
    </message>
</context>
<context>
    <name>episcope::CommandPalette</name>
    <message>
        <source>Words of a command, method or light field</source>
        <translation>Wörter eines Befehls, Verfahrens oder Lichtfelds</translation>
    </message>
    <message>
        <source>Type words of a command, method or light field</source>
        <translation>Wörter eines Befehls, Verfahrens oder Lichtfelds eingeben</translation>
    </message>
    <message>
        <source>What was found</source>
        <translation>Gefundenes</translation>
    </message>
    <message>
        <source>Nothing has this name or description.</source>
        <translation>Nichts hat diesen Namen oder diese Beschreibung.</translation>
    </message>
</context>
<context>
    <name>episcope::CompareBar</name>
    <message>
        <source>A: the result shown</source>
        <translation>A: das angezeigte Ergebnis</translation>
    </message>
    <message>
        <source>B: the result it is compared with</source>
        <translation>B: das Ergebnis, mit dem verglichen wird</translation>
    </message>
    <message>
        <source>no result</source>
        <translation>kein Ergebnis</translation>
    </message>
    <message>
        <source>Map</source>
        <translation>Karte</translation>
    </message>
</context>
<context>
    <name>episcope::CompareController</name>
    <message>
        <source>Compare</source>
        <translation>Vergleichen</translation>
    </message>
    <message>
        <source>Compare tab</source>
        <translation>Reiter Vergleichen</translation>
    </message>
    <message>
        <source>Shows the table of metrics</source>
        <translation>Zeigt die Tabelle der Fehlermaße</translation>
    </message>
    <message>
        <source>Next map</source>
        <translation>Nächste Karte</translation>
    </message>
    <message>
        <source>Shows the next map over the view</source>
        <translation>Zeigt die nächste Karte über der Ansicht</translation>
    </message>
    <message>
        <source>Flip to B</source>
        <translation>Auf B umschalten</translation>
    </message>
    <message>
        <source>Shows B, the compared result, while the key is held in the view or a list</source>
        <translation>Zeigt B, das Vergleichsergebnis, solange die Taste in der Ansicht oder einer Liste gehalten wird</translation>
    </message>
    <message>
        <source>Difference A − B</source>
        <translation>Differenz A − B</translation>
    </message>
    <message>
        <source>Shows A minus B, the result shown minus the one it is compared with</source>
        <translation>Zeigt A minus B, das angezeigte Ergebnis minus das Vergleichsergebnis</translation>
    </message>
    <message>
        <source>Swap A and B</source>
        <translation>A und B tauschen</translation>
    </message>
    <message>
        <source>Shows B and compares it with A</source>
        <translation>Zeigt B und vergleicht es mit A</translation>
    </message>
    <message>
        <source>Wipe</source>
        <translation>Wischen</translation>
    </message>
    <message>
        <source>Shows A to the left and B to the right of a divider that can be dragged</source>
        <translation>Zeigt A links und B rechts einer Trennlinie, die sich ziehen lässt</translation>
    </message>
    <message>
        <source>Side by side</source>
        <translation>Nebeneinander</translation>
    </message>
    <message>
        <source>Shows A beside B</source>
        <translation>Zeigt A neben B</translation>
    </message>
    <message>
        <source>Tiles</source>
        <translation>Kacheln</translation>
    </message>
    <message>
        <source>Shows the view, the ground truth and every result</source>
        <translation>Zeigt die Ansicht, die Referenz und alle Ergebnisse</translation>
    </message>
    <message>
        <source>%1 · MSE×100 %2</source>
        <translation>%1 · MSE×100 %2</translation>
    </message>
    <message>
        <source>view</source>
        <translation>Ansicht</translation>
    </message>
    <message>
        <source>ground truth</source>
        <translation>Referenz</translation>
    </message>
    <message>
        <source>%1 · no such map for this view</source>
        <translation>%1 · keine solche Karte für diese Ansicht</translation>
    </message>
    <message>
        <source>Colored view under maps</source>
        <translation>Farbige Ansicht unter Karten</translation>
    </message>
    <message>
        <source>Keeps the colors of the view under maps. Otherwise it is grey, so that only the map has colors</source>
        <translation>Lässt der Ansicht unter Karten ihre Farben. Sonst ist sie grau, sodass nur die Karte Farben hat</translation>
    </message>
    <message>
        <source>Table</source>
        <translation>Tabelle</translation>
    </message>
    <message>
        <source>%1 · %2 … %3</source>
        <translation>%1 · %2 … %3</translation>
    </message>
</context>
<context>
    <name>episcope::ConventionsDialog</name>
    <message>
        <source>Conventions</source>
        <translation>Konventionen</translation>
    </message>
    <message>
        <source>The file will be read again and your choice remembered. Results of this light field will be removed from the list.</source>
        <translation>Die Datei wird neu gelesen und die Wahl gemerkt. Ergebnisse dieses Lichtfelds werden aus der Liste entfernt.</translation>
    </message>
    <message>
        <source>Read again</source>
        <translation>Neu lesen</translation>
    </message>
    <message>
        <source>All automatic</source>
        <translation>Alles automatisch</translation>
    </message>
</context>
<context>
    <name>episcope::Dialogs</name>
    <message>
        <source>%1 was not written: its name must end in .%2.</source>
        <translation>%1 wurde nicht geschrieben: der Name muss auf .%2 enden.</translation>
    </message>
    <message>
        <source> or .</source>
        <translation> oder .</translation>
    </message>
    <message>
        <source>Writing %1</source>
        <translation>Schreiben von %1</translation>
    </message>
    <message>
        <source>Open this folder</source>
        <translation>Diesen Ordner öffnen</translation>
    </message>
</context>
<context>
    <name>episcope::DocumentController</name>
    <message>
        <source>The scribbles on “%1” belong to a light field of another size; they are kept in the project.</source>
        <translation>Was in „%1“ gemalt wurde, gehört zu einem Lichtfeld anderer Größe; es bleibt im Projekt erhalten.</translation>
    </message>
    <message>
        <source>The scribbles of this light field cannot be edited: %1. They are left unchanged; new scribbles are saved to another file.</source>
        <translation>Die Striche dieses Lichtfelds können nicht bearbeitet werden: %1. Sie bleiben unverändert, und neu Gemaltes wird in einer anderen Datei gespeichert.</translation>
    </message>
    <message>
        <source>Scribbles can no longer be recovered after a crash, so save them soon: %1</source>
        <translation>Gemaltes kann nach einem Absturz nicht mehr wiederhergestellt werden, also bald speichern: %1</translation>
    </message>
    <message>
        <source>The scribbles on “%1” belong to a light field of another size; they are offered again at the next start.</source>
        <translation>Was auf „%1“ gemalt wurde, gehört zu einem Lichtfeld anderer Größe; es wird beim nächsten Start wieder angeboten.</translation>
    </message>
</context>
<context>
    <name>episcope::EdgeSource</name>
    <message>
        <source>Boundaries follow the edge weights of the file beside the light field.</source>
        <translation>Grenzen folgen den Kantengewichten der Datei neben dem Lichtfeld.</translation>
    </message>
    <message>
        <source>Boundaries follow edges computed from the image and, where it is known, the disparity.</source>
        <translation>Grenzen folgen Kanten, die aus dem Bild und, wo bekannt, der Disparität berechnet werden.</translation>
    </message>
    <message>
        <source>%1. Edges are computed instead.</source>
        <translation>%1. Stattdessen werden Kanten berechnet.</translation>
    </message>
</context>
<context>
    <name>episcope::EpiPane</name>
    <message>
        <source>Horizontal EPI</source>
        <translation>Horizontales EPI</translation>
    </message>
    <message>
        <source>Vertical EPI</source>
        <translation>Vertikales EPI</translation>
    </message>
    <message>
        <source>Epipolar plane image through the cross-hair. Drag along a line to measure its disparity; click to move the cross-hair; wheel to zoom.</source>
        <translation>Epipolarebenenbild durch das Fadenkreuz. Entlang einer Linie ziehen, um ihre Disparität zu messen; klicken, um das Fadenkreuz zu versetzen; mit dem Mausrad zoomen.</translation>
    </message>
    <message>
        <source>u ↓  x →</source>
        <translation>u ↓  x →</translation>
    </message>
    <message>
        <source>v ↓  y →</source>
        <translation>v ↓  y →</translation>
    </message>
    <message>
        <source>v →  y ↓</source>
        <translation>v →  y ↓</translation>
    </message>
    <message>
        <source>one column of views</source>
        <translation>eine Spalte von Ansichten</translation>
    </message>
    <message>
        <source>one row of views</source>
        <translation>eine Zeile von Ansichten</translation>
    </message>
    <message>
        <source>measured</source>
        <translation>gemessen</translation>
    </message>
    <message>
        <source>ground truth behind</source>
        <translation>Referenz dahinter</translation>
    </message>
    <message>
        <source>ground truth</source>
        <translation>Referenz</translation>
    </message>
    <message>
        <source>estimate behind</source>
        <translation>Schätzung dahinter</translation>
    </message>
    <message>
        <source>estimate</source>
        <translation>Schätzung</translation>
    </message>
</context>
<context>
    <name>episcope::EpiStripView</name>
    <message>
        <source>EPIs through the label</source>
        <translation>EPIs durch das Label</translation>
    </message>
</context>
<context>
    <name>episcope::ErrorPlotController</name>
    <message>
        <source>Errors</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>Errors tab</source>
        <translation>Reiter Fehler</translation>
    </message>
    <message>
        <source>Plots errors against the true disparity</source>
        <translation>Trägt Fehler über der wahren Disparität auf</translation>
    </message>
    <message>
        <source>Ctrl+Alt+B</source>
        <translation>Ctrl+Alt+B</translation>
    </message>
    <message>
        <source>Open a light field with ground truth and run a method.</source>
        <translation>Ein Lichtfeld mit Referenz (Ground Truth) öffnen und ein Verfahren ausführen.</translation>
    </message>
    <message>
        <source>This light field has no ground truth to compare results with.</source>
        <translation>Dieses Lichtfeld hat keine Referenz (Ground Truth), mit der sich Ergebnisse vergleichen ließen.</translation>
    </message>
    <message>
        <source>Run a method: its errors by true disparity appear here.</source>
        <translation>Ein Verfahren ausführen: seine Fehler über der wahren Disparität erscheinen hier.</translation>
    </message>
    <message>
        <source>%1 has no map of the view with the ground truth.</source>
        <translation>%1 hat keine Karte der Ansicht, von der die Referenz ist.</translation>
    </message>
    <message>
        <source>True disparity [px]</source>
        <translation>Wahre Disparität [px]</translation>
    </message>
    <message>
        <source>MSE×100 [px²]</source>
        <translation>MSE×100 [px²]</translation>
    </message>
    <message>
        <source>No pixel of the %1 can be evaluated.</source>
        <translation>Kein Pixel wird bewertet: %1.</translation>
    </message>
    <message>
        <source>%1 · %2, %3 px</source>
        <translation>%1 · %2, %3 px</translation>
    </message>
    <message>
        <source>Bad pixels: off by more than %1 px [%]</source>
        <translation>Schlechte Pixel: um mehr als %1 px falsch [%]</translation>
    </message>
</context>
<context>
    <name>episcope::ErrorPlotPanel</name>
    <message>
        <source>Mean squared error by true disparity</source>
        <translation>Mittlerer quadratischer Fehler über der wahren Disparität</translation>
    </message>
    <message>
        <source>Bad pixels by true disparity</source>
        <translation>Schlechte Pixel über der wahren Disparität</translation>
    </message>
</context>
<context>
    <name>episcope::EstimateController</name>
    <message>
        <source>Run</source>
        <translation>Starten</translation>
    </message>
    <message>
        <source>Runs the chosen method with the parameters of the form</source>
        <translation>Führt das gewählte Verfahren mit den Parametern des Formulars aus</translation>
    </message>
    <message>
        <source>Ctrl+Return</source>
        <translation>Ctrl+Return</translation>
    </message>
    <message>
        <source>Run on several…</source>
        <translation>Auf mehrere anwenden…</translation>
    </message>
    <message>
        <source>Runs one or several methods on open light fields</source>
        <translation>Wendet ein oder mehrere Verfahren auf geöffnete Lichtfelder an</translation>
    </message>
    <message>
        <source>Shift+F5</source>
        <translation>Shift+F5</translation>
    </message>
    <message>
        <source>Sweep parameters…</source>
        <translation>Parameter variieren…</translation>
    </message>
    <message>
        <source>Runs the method with several values of one or two parameters</source>
        <translation>Führt das Verfahren mit mehreren Werten eines oder zweier Parameter aus</translation>
    </message>
    <message>
        <source>Ctrl+Shift+F5</source>
        <translation>Ctrl+Shift+F5</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Cancels the current gesture, mode or job</source>
        <translation>Bricht die aktuelle Geste, den Modus oder den Auftrag ab</translation>
    </message>
    <message>
        <source>Copy as command</source>
        <translation>Als Befehl kopieren</translation>
    </message>
    <message>
        <source>Copies the command line that runs the method with the parameters of the form</source>
        <translation>Kopiert die Befehlszeile, die das Verfahren mit den Parametern des Formulars ausführt</translation>
    </message>
    <message>
        <source>Ctrl+Shift+C</source>
        <translation>Ctrl+Shift+C</translation>
    </message>
    <message>
        <source>Note on result…</source>
        <translation>Notiz zum Ergebnis…</translation>
    </message>
    <message>
        <source>Writes a note on the shown result, kept with the project</source>
        <translation>Schreibt eine Notiz zum angezeigten Ergebnis, die im Projekt bleibt</translation>
    </message>
    <message>
        <source>Ctrl+Alt+N</source>
        <translation>Ctrl+Alt+N</translation>
    </message>
    <message>
        <source>Next result</source>
        <translation>Nächstes Ergebnis</translation>
    </message>
    <message>
        <source>Shows the next result of the list</source>
        <translation>Zeigt das nächste Ergebnis der Liste</translation>
    </message>
    <message>
        <source>Ctrl+PgDown</source>
        <translation>Ctrl+PgDown</translation>
    </message>
    <message>
        <source>Previous result</source>
        <translation>Voriges Ergebnis</translation>
    </message>
    <message>
        <source>Shows the previous result of the list</source>
        <translation>Zeigt das vorige Ergebnis der Liste</translation>
    </message>
    <message>
        <source>Ctrl+PgUp</source>
        <translation>Ctrl+PgUp</translation>
    </message>
    <message>
        <source>Remove result</source>
        <translation>Ergebnis entfernen</translation>
    </message>
    <message>
        <source>Removes the shown result from the list</source>
        <translation>Entfernt das angezeigte Ergebnis aus der Liste</translation>
    </message>
    <message>
        <source>Ctrl+Delete</source>
        <translation>Ctrl+Delete</translation>
    </message>
    <message>
        <source>Restore removed result</source>
        <translation>Entferntes Ergebnis zurückholen</translation>
    </message>
    <message>
        <source>Restores the result removed last</source>
        <translation>Holt das zuletzt entfernte Ergebnis zurück</translation>
    </message>
    <message>
        <source>Ctrl+Shift+Delete</source>
        <translation>Ctrl+Shift+Delete</translation>
    </message>
    <message>
        <source>Writes the shown result: HDF5, PFM, TIFF or PLY</source>
        <translation>Schreibt das angezeigte Ergebnis: HDF5, PFM, TIFF oder PLY</translation>
    </message>
    <message>
        <source>Ctrl+E</source>
        <translation>Ctrl+E</translation>
    </message>
    <message>
        <source>Adds the shown result to a submission to the 2016 benchmark</source>
        <translation>Fügt das angezeigte Ergebnis einer Einreichung zum Benchmark von 2016 hinzu</translation>
    </message>
    <message>
        <source>One view</source>
        <translation>Eine Ansicht</translation>
    </message>
    <message>
        <source>%1×%2 views</source>
        <translation>%1×%2 Ansichten</translation>
    </message>
    <message>
        <source>Searched %1 … %2 px</source>
        <translation>Abgesucht: %1 … %2 px</translation>
    </message>
    <message>
        <source>Estimate</source>
        <translation>Schätzen</translation>
    </message>
    <message>
        <source>Estimate tab</source>
        <translation>Reiter Schätzen</translation>
    </message>
    <message>
        <source>Shows methods and results</source>
        <translation>Zeigt Verfahren und Ergebnisse</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>Note on %1:</source>
        <translation>Notiz zu %1:</translation>
    </message>
    <message>
        <source>Removed: %1</source>
        <translation>Entfernt: %1</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Rückgängig</translation>
    </message>
    <message>
        <source>Copied: %1</source>
        <translation>Kopiert: %1</translation>
    </message>
    <message>
        <source>Result…</source>
        <translation>Ergebnis…</translation>
    </message>
    <message>
        <source>Result for a submission…</source>
        <translation>Ergebnis zum Einreichen…</translation>
    </message>
    <message>
        <source>Method: %1</source>
        <translation>Verfahren: %1</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>Verfahren</translation>
    </message>
</context>
<context>
    <name>episcope::ExportLabelsDialog</name>
    <message>
        <source>Export labels</source>
        <translation>Labels exportieren</translation>
    </message>
    <message>
        <source>With the views as pictures</source>
        <translation>Mit den Ansichten als Bildern</translation>
    </message>
    <message>
        <source>Labels (HDF5)</source>
        <translation>Labels (HDF5)</translation>
    </message>
    <message>
        <source>Labels and probabilities (HDF5)</source>
        <translation>Labels und Wahrscheinlichkeiten (HDF5)</translation>
    </message>
    <message>
        <source>PNG with a palette, one for each view</source>
        <translation>PNG mit Palette, eines je Ansicht</translation>
    </message>
    <message>
        <source>PASCAL VOC</source>
        <translation>PASCAL VOC</translation>
    </message>
    <message>
        <source>COCO</source>
        <translation>COCO</translation>
    </message>
    <message>
        <source>labelme</source>
        <translation>labelme</translation>
    </message>
    <message>
        <source>Picture of this view (PNG)</source>
        <translation>Bild dieser Ansicht (PNG)</translation>
    </message>
    <message>
        <source>Labels of all views.</source>
        <translation>Labels aller Ansichten.</translation>
    </message>
    <message>
        <source>Labels of this view; segment all views first to export all.</source>
        <translation>Labels dieser Ansicht; für alle erst alle Ansichten segmentieren.</translation>
    </message>
    <message>
        <source>These labels are out of date: strokes or settings changed since.</source>
        <translation>Diese Labels sind veraltet: Striche oder Einstellungen haben sich seither geändert.</translation>
    </message>
    <message>
        <source>Export…</source>
        <translation>Exportieren…</translation>
    </message>
    <message>
        <source>Form</source>
        <translation>Form</translation>
    </message>
    <message>
        <source>New folder for the labels</source>
        <translation>Neuer Ordner für die Labels</translation>
    </message>
    <message>
        <source>Folder (*)</source>
        <translation>Ordner (*)</translation>
    </message>
    <message>
        <source>Picture (*.png)</source>
        <translation>Bild (*.png)</translation>
    </message>
    <message>
        <source>Labels (*.h5)</source>
        <translation>Labels (*.h5)</translation>
    </message>
    <message>
        <source>Labels…</source>
        <translation>Labels…</translation>
    </message>
    <message>
        <source>Writes labels as HDF5, or in the forms of other tools: PNG, VOC, COCO, labelme</source>
        <translation>Schreibt Labels als HDF5 oder in den Formen anderer Programme: PNG, VOC, COCO, labelme</translation>
    </message>
    <message>
        <source>Nothing is segmented yet: paint two labels, then update the segmentation.</source>
        <translation>Noch ist nichts segmentiert: zwei Labels malen, dann die Segmentierung aktualisieren.</translation>
    </message>
    <message>
        <source>They were read from a file: segment again to export probabilities as well.</source>
        <translation>Sie wurden aus einer Datei gelesen: Neu segmentieren, um auch Wahrscheinlichkeiten zu exportieren.</translation>
    </message>
</context>
<context>
    <name>episcope::FileController</name>
    <message>
        <source>Ctrl+Shift+O</source>
        <translation>Ctrl+Shift+O</translation>
    </message>
    <message>
        <source>Read again</source>
        <translation>Neu lesen</translation>
    </message>
    <message>
        <source>Reads the open light field again, with what a program has added to its file since</source>
        <translation>Liest das Geöffnete noch einmal, so wie ein Programm, das noch daran schreibt, es inzwischen hinterlassen hat</translation>
    </message>
    <message>
        <source>Ctrl+F5</source>
        <translation>Ctrl+F5</translation>
    </message>
    <message>
        <source>Adds a result from a file to the list</source>
        <translation>Fügt der Liste ein Ergebnis aus einer Datei hinzu</translation>
    </message>
    <message>
        <source>Ctrl+R</source>
        <translation>Ctrl+R</translation>
    </message>
    <message>
        <source>Reopens a recent light field</source>
        <translation>Öffnet ein kürzlich geöffnetes Lichtfeld</translation>
    </message>
    <message>
        <source>Opens the built-in demo scene</source>
        <translation>Öffnet die eingebaute Demoszene</translation>
    </message>
    <message>
        <source>Built-in scenes…</source>
        <translation>Eingebaute Szenen…</translation>
    </message>
    <message>
        <source>Opens one of the built-in scenes, or a random one of a seed</source>
        <translation>Öffnet eine der eingebauten Szenen oder eine zufällige zu einem Startwert</translation>
    </message>
    <message>
        <source>Writes the light field, its ground truth and its labels in another form</source>
        <translation>Schreibt das Lichtfeld, seine Referenz und seine Labels in anderer Form</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Closes the light field</source>
        <translation>Schließt das Lichtfeld</translation>
    </message>
    <message>
        <source>Ctrl+W</source>
        <translation>Ctrl+W</translation>
    </message>
    <message>
        <source>Quit</source>
        <translation>Beenden</translation>
    </message>
    <message>
        <source>Quits Episcope</source>
        <translation>Beendet Episcope</translation>
    </message>
    <message>
        <source>Ctrl+Q</source>
        <translation>Ctrl+Q</translation>
    </message>
    <message>
        <source>Open a result</source>
        <translation>Ergebnis öffnen</translation>
    </message>
    <message>
        <source>Clear list</source>
        <translation>Liste leeren</translation>
    </message>
    <message>
        <source>Open a light field, or drop a file or a folder here.</source>
        <translation>Ein Lichtfeld öffnen oder eine Datei oder einen Ordner hier ablegen.</translation>
    </message>
    <message>
        <source>Open a light field with %1, or drop a file or a folder here.</source>
        <translation>Ein Lichtfeld mit %1 öffnen oder eine Datei oder einen Ordner hier ablegen.</translation>
    </message>
    <message>
        <source>Choose one in the list at the upper left.</source>
        <translation>Eines aus der Liste oben links wählen.</translation>
    </message>
    <message>
        <source>Opens a file or a folder: a light field, a folder of several, a result or a project</source>
        <translation>Öffnet eine Datei oder einen Ordner: ein Lichtfeld, einen Ordner mit mehreren, ein Ergebnis oder ein Projekt</translation>
    </message>
    <message>
        <source>Open a light field, a result or a project</source>
        <translation>Lichtfeld, Ergebnis oder Projekt öffnen</translation>
    </message>
    <message>
        <source>Results (*.h5 *.hdf5 *.pfm *.tif *.tiff *.npy *.npz *.mat *.csv);;All files (*)</source>
        <translation>Ergebnisse (*.h5 *.hdf5 *.pfm *.tif *.tiff *.npy *.npz *.mat *.csv);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Opening %1</source>
        <translation>Öffnen von %1</translation>
    </message>
    <message>
        <source>Result of another light field</source>
        <translation>Ergebnis eines anderen Lichtfelds</translation>
    </message>
    <message>
        <source>%1 was estimated from the light field %2.</source>
        <translation>%1 wurde aus dem Lichtfeld %2 geschätzt.</translation>
    </message>
    <message>
        <source>%1 lies in the folder of the light field %2.</source>
        <translation>%1 liegt im Ordner des Lichtfelds %2.</translation>
    </message>
    <message>
        <source>Open that light field</source>
        <translation>Dieses Lichtfeld öffnen</translation>
    </message>
    <message>
        <source>Add to “%1”</source>
        <translation>Zu „%1“ hinzufügen</translation>
    </message>
    <message>
        <source>File or folder…</source>
        <translation>Datei oder Ordner…</translation>
    </message>
    <message>
        <source>Result…</source>
        <translation>Ergebnis…</translation>
    </message>
    <message>
        <source>Recent</source>
        <translation>Zuletzt geöffnet</translation>
    </message>
    <message>
        <source>Demo</source>
        <translation>Demo</translation>
    </message>
    <message>
        <source>Light field</source>
        <translation>Lichtfeld</translation>
    </message>
    <message>
        <source>Recent: %1</source>
        <translation>Zuletzt geöffnet: %1</translation>
    </message>
    <message>
        <source>Opens it again</source>
        <translation>Öffnet es wieder</translation>
    </message>
</context>
<context>
    <name>episcope::Finding</name>
    <message>
        <source>the map fits the ground truth of view %1 far better than that of view %2: MSE×100 %3 instead of %4; name the view that it is of</source>
        <translation>die Karte passt weit besser zur Referenz der Ansicht %1 als zu der von Ansicht %2: MSE×100 %3 statt %4; nennen Sie die Ansicht, zu der sie gehört</translation>
    </message>
    <message>
        <source>the map is off by %1 px everywhere: without that, MSE×100 would be %2 instead of %3; check which focus plane it belongs to (--focus)</source>
        <translation>die Karte weicht überall um %1 px ab: sonst wäre MSE×100 %2 statt %3; prüfen Sie, zu welcher Fokusebene sie gehört (--focus)</translation>
    </message>
    <message>
        <source>the map fits the ground truth far better with %1 (%2)</source>
        <translation>die Karte passt weit besser zur Referenz so: %1 (%2)</translation>
    </message>
    <message>
        <source>the map fits the ground truth far better with %1 (%2), but the views fit it as it is</source>
        <translation>die Karte passt weit besser zur Referenz so: %1 (%2), aber die Ansichten passen zu ihr, wie sie ist</translation>
    </message>
    <message>
        <source>the map explains the views far better with %1 (%2)</source>
        <translation>die Karte erklärt die Ansichten weit besser so: %1 (%2)</translation>
    </message>
    <message>
        <source>Shapes of the type %1 in %2 cannot be read: they are left out.</source>
        <translation>Formen vom Typ %1 in %2 sind nicht lesbar: sie werden ausgelassen.</translation>
    </message>
    <message>
        <source>Shapes of the type %1 are left out.</source>
        <translation>Formen vom Typ %1 werden ausgelassen.</translation>
    </message>
    <message>
        <source>%1 % of all pixels, in %2 of %3 views, are dark where the center view is not; they are marked as not valid.</source>
        <translation>%1 % aller Pixel, in %2 von %3 Ansichten, sind dunkel, wo die mittlere Ansicht es nicht ist; sie sind als ungültig markiert.</translation>
    </message>
    <message>
        <source>%1 % of the float samples of the views lie clearly below 0, down to %2: they are taken as noise around black. --levels -1,1 would say otherwise.</source>
        <translation>%1 % der Gleitkomma-Samples der Ansichten liegen deutlich unter 0, bis %2: Sie gelten als Rauschen um Schwarz. --levels -1,1 besagte anderes.</translation>
    </message>
    <message>
        <source>%1 % of the pixels are dark and do not count.</source>
        <translation>%1 % der Pixel sind dunkel und zählen nicht.</translation>
    </message>
    <message>
        <source>%1 % of the samples are negative</source>
        <translation>%1 % der Samples sind negativ</translation>
    </message>
    <message>
        <source>%1 % of the samples clipped</source>
        <translation>%1 % der Samples abgeschnitten</translation>
    </message>
    <message>
        <source>%1 %2 (other way %3), %4 %5 (other way %6)</source>
        <translation>%1 %2 (andersherum %3), %4 %5 (andersherum %6)</translation>
    </message>
    <message>
        <source>%1 holds no depth at %2 % of its pixels (masked, zero, negative or NaN); they are ignored.</source>
        <translation>%1 enthält an %2 % der Pixel keine Tiefe (maskiert, null, negativ oder NaN); sie werden nicht verwendet.</translation>
    </message>
    <message>
        <source>%1 images look like views, but their names have another form, such as %2: they are not used. If they belong to the grid, name a pattern that matches all.</source>
        <translation>%1 Bilder sehen wie Ansichten aus, aber ihre Namen haben eine andere Form, wie %2: Sie werden nicht verwendet. Gehören sie zum Gitter, ein Muster angeben, auf das alle passen.</translation>
    </message>
    <message>
        <source>%1 images with other names are not used.</source>
        <translation>%1 Bilder mit anderen Namen werden nicht verwendet.</translation>
    </message>
    <message>
        <source>%1 is ignored because %2.</source>
        <translation>%1 wird nicht verwendet: %2.</translation>
    </message>
    <message>
        <source>%1 is ignored because the other layer, %2, is missing or holds no depth; add it, or store a single layer as GT_DEPTH.</source>
        <translation>%1 wird nicht verwendet, weil die andere Schicht, %2, fehlt oder keine Tiefe enthält; sie hinzufügen oder eine einzelne Schicht als GT_DEPTH speichern.</translation>
    </message>
    <message>
        <source>%1 is ignored.</source>
        <translation>%1 wird nicht verwendet.</translation>
    </message>
    <message>
        <source>%1 is ignored: one layer is missing.</source>
        <translation>%1 wird nicht verwendet: Eine Schicht fehlt.</translation>
    </message>
    <message>
        <source>%1 of %2 samples of the views are NaN or infinite; their pixels do not count.</source>
        <translation>%1 von %2 Samples der Ansichten sind NaN oder unendlich; ihre Pixel zählen nicht.</translation>
    </message>
    <message>
        <source>%1 samples are NaN or infinite</source>
        <translation>%1 Samples sind NaN oder unendlich</translation>
    </message>
    <message>
        <source>%1: %2 % of the pixels have no value and count as good pixels; means leave them out, as the 2016 tool does</source>
        <translation>%1: %2 % der Pixel haben keinen Wert und zählen als gute Pixel; Mittelwerte lassen sie aus, wie das Werkzeug von 2016</translation>
    </message>
    <message>
        <source>%1: %2 % of the pixels have no value and count as the farthest true disparity, %3 px: MSE×100 is %4 with and %5 without them</source>
        <translation>%1: %2 % der Pixel haben keinen Wert und zählen als die fernste wahre Disparität, %3 px: MSE×100 ist %4 mit ihnen und %5 ohne sie</translation>
    </message>
    <message>
        <source>%1: %2 % of the pixels have no value and count as the farthest true disparity, %3 px: there is no other pixel</source>
        <translation>%1: %2 % der Pixel haben keinen Wert und zählen als die fernste wahre Disparität, %3 px: Es gibt kein anderes Pixel</translation>
    </message>
    <message>
        <source>A first label of 0 has no effect on colors, which are no numbers.</source>
        <translation>Ein erstes Label 0 ändert an Farben nichts, denn sie sind keine Zahlen.</translation>
    </message>
    <message>
        <source>The range searched, %1 … %2 px, does not hold all of the range that the light field states, %3 … %4 px</source>
        <translation>Der durchsuchte Bereich, %1 … %2 px, enthält nicht den ganzen Bereich, den das Lichtfeld angibt, %3 … %4 px</translation>
    </message>
    <message>
        <source>The labels of this file are no ground truth: they were %1.</source>
        <translation>Die Labels dieser Datei sind keine Referenz: %1.</translation>
    </message>
    <message>
        <source>--%1 is ignored, because this is %2.</source>
        <translation>--%1 wird nicht verwendet, denn dies ist %2.</translation>
    </message>
    <message>
        <source>-1 for black, 1 for white</source>
        <translation>-1 für Schwarz, 1 für Weiß</translation>
    </message>
    <message>
        <source>According to dH, focalLength and shift, disparity is zero at depth %1, but camDistance says %2; camDistance is ignored; check these attributes of the file.</source>
        <translation>Nach dH, focalLength und shift ist die Disparität in der Tiefe %1 null, aber camDistance besagt %2; camDistance wird nicht verwendet; diese Attribute der Datei prüfen.</translation>
    </message>
    <message>
        <source>According to dH, focalLength and shift, disparity is zero at no finite depth, but camDistance says %1; camDistance is ignored; check these attributes of the file.</source>
        <translation>Nach dH, focalLength und shift ist die Disparität in keiner endlichen Tiefe null, aber camDistance besagt %1; camDistance wird nicht verwendet; diese Attribute der Datei prüfen.</translation>
    </message>
    <message>
        <source>Black is taken at %3, white at %4</source>
        <translation>Schwarz gilt bei %3, Weiß bei %4</translation>
    </message>
    <message>
        <source>Brightness differs by %1 %</source>
        <translation>Helligkeit verschieden, bis %1 %</translation>
    </message>
    <message>
        <source>Float samples of the views reach up to %1 with a median of %2: they are taken as linear, and divided by %3 so that 99.9 % lie in 0 … 1.</source>
        <translation>Gleitkomma-Samples der Ansichten reichen bis %1 bei einem Median von %2: Sie gelten als linear und werden durch %3 geteilt, sodass 99.9 % in 0 … 1 liegen.</translation>
    </message>
    <message>
        <source>Float samples of the views should lie in 0 … 1, but lie in %1 … %2: %3 … %4 is taken as black to white (%5). --levels states other values.</source>
        <translation>Gleitkomma-Samples der Ansichten sollten in 0 … 1 liegen, liegen aber in %1 … %2: %3 … %4 gilt als Schwarz bis Weiß (%5). --levels gibt andere Werte an.</translation>
    </message>
    <message>
        <source>Float samples of the views should lie in 0 … 1, but reach up to %1; they are divided by %2.</source>
        <translation>Gleitkomma-Samples der Ansichten sollten in 0 … 1 liegen, reichen aber bis %1; sie werden durch %2 geteilt.</translation>
    </message>
    <message>
        <source>Implausible depth: %1 … %2 px</source>
        <translation>Unplausible Tiefe: %1 … %2 px</translation>
    </message>
    <message>
        <source>K = %1 (1/255)²; energy fell by %2 K in %3 cycles</source>
        <translation>K = %1 (1/255)²; die Energie fiel in %3 Zyklen um %2 K</translation>
    </message>
    <message>
        <source>K = %1 (1/255)²; energy fell by %2 K in %3 cycles, to a minimum</source>
        <translation>K = %1 (1/255)²; die Energie fiel in %3 Zyklen um %2 K bis zu einem Minimum</translation>
    </message>
    <message>
        <source>Labels are raised by one.</source>
        <translation>Labels sind um eins erhöht.</translation>
    </message>
    <message>
        <source>Labels start at 0 in this file and unpainted pixels are marked by another value: all labels are raised by one, so that 0 means unpainted.</source>
        <translation>Labels beginnen in dieser Datei bei 0, und unbemalte Pixel haben einen anderen Wert: Alle Labels werden um eins erhöht, sodass 0 unbemalt heißt.</translation>
    </message>
    <message>
        <source>Linear samples, divided by %3</source>
        <translation>Lineare Samples, durch %3 geteilt</translation>
    </message>
    <message>
        <source>No depth at %2 % of the pixels of %1</source>
        <translation>Keine Tiefe an %2 % der Pixel von %1</translation>
    </message>
    <message>
        <source>No sample of the views exceeds %1 of 65535: they are taken as samples of %2 bits. --levels 0,65535 keeps them as they are.</source>
        <translation>Kein Sample der Ansichten liegt über %1 von 65535: Sie gelten als Samples von %2 Bit. --levels 0,65535 lässt sie, wie sie sind.</translation>
    </message>
    <message>
        <source>Of %1 channels of a view the first three are read, as red, green and blue.</source>
        <translation>Von %1 Kanälen einer Ansicht werden die ersten drei gelesen, als Rot, Grün und Blau.</translation>
    </message>
    <message>
        <source>Of a grid of %1×%2 %3 (row,column %4): the largest part without a gap is opened, %5×%6 views, %7 and %8; %9 other view is not used.</source>
        <translation>Von einem Gitter von %1×%2 %3 (Zeile,Spalte %4) ist der größte Teil ohne Lücke geöffnet, %5×%6 Ansichten, %7 und %8; %9 weitere Ansicht wird nicht verwendet.</translation>
    </message>
    <message>
        <source>Of a grid of %1×%2 %3 (row,column %4): the largest part without a gap is opened, %5×%6 views, %7 and %8; %9 other views are not used.</source>
        <translation>Von einem Gitter von %1×%2 %3 (Zeile,Spalte %4) ist der größte Teil ohne Lücke geöffnet, %5×%6 Ansichten, %7 und %8; %9 weitere Ansichten werden nicht verwendet.</translation>
    </message>
    <message>
        <source>Only three of %1 channels are read.</source>
        <translation>Nur drei von %1 Kanälen werden gelesen.</translation>
    </message>
    <message>
        <source>Perhaps a %3 of views is missing.</source>
        <translation>Vielleicht fehlen Ansichten (%3).</translation>
    </message>
    <message>
        <source>Pictures in %2 are left out.</source>
        <translation>Bilder in %2 bleiben aus.</translation>
    </message>
    <message>
        <source>Points move across the line of views as well.</source>
        <translation>Punkte bewegen sich auch quer zur Reihe der Ansichten.</translation>
    </message>
    <message>
        <source>Points move across the line of views as well: by %1 px between views %2 apart, beside %3 px along it. This may be a film of a camera that zooms or turns, or views that are not rectified; disparity is not to be trusted then.</source>
        <translation>Punkte bewegen sich auch quer zur Reihe der Ansichten: um %1 px zwischen Ansichten im Abstand %2, neben %3 px längs. Das kann ein Film einer Kamera sein, die zoomt oder sich dreht, oder Ansichten sind nicht rektifiziert; der Disparität ist dann nicht zu trauen.</translation>
    </message>
    <message>
        <source>Rows and columns of views seem to be swapped.</source>
        <translation>Zeilen und Spalten der Ansichten scheinen vertauscht.</translation>
    </message>
    <message>
        <source>Rows and columns of views seem to be swapped: %1.</source>
        <translation>Zeilen und Spalten der Ansichten scheinen vertauscht: %1.</translation>
    </message>
    <message>
        <source>Rows begin at %1 and columns at %2: perhaps a %3 of views is missing.</source>
        <translation>Zeilen beginnen bei %1 und Spalten bei %2: Vielleicht fehlt etwas (%3).</translation>
    </message>
    <message>
        <source>Samples are divided by %2</source>
        <translation>Samples werden durch %2 geteilt</translation>
    </message>
    <message>
        <source>Samples of %2 bits</source>
        <translation>Samples von %2 Bit</translation>
    </message>
    <message>
        <source>Scribbles were not read: %1</source>
        <translation>Striche wurden nicht gelesen: %1</translation>
    </message>
    <message>
        <source>The brightness of the views differs by up to %1 % (view %2: %3); without --no-equalize, methods even it out.</source>
        <translation>Die Helligkeit der Ansichten unterscheidet sich um bis zu %1 % (Ansicht %2: %3); ohne --no-equalize gleichen Verfahren sie an.</translation>
    </message>
    <message>
        <source>The camera of the file is not used.</source>
        <translation>Die Kamera der Datei wird nicht verwendet.</translation>
    </message>
    <message>
        <source>The camera of the file is not used: %1.</source>
        <translation>Die Kamera der Datei wird nicht verwendet: %1.</translation>
    </message>
    <message>
        <source>The check favors another order of views.</source>
        <translation>Die Prüfung spricht für eine andere Reihenfolge.</translation>
    </message>
    <message>
        <source>The corners of the views are black, %1 % of their pixels, as a lens cuts them off; they are marked as not valid.</source>
        <translation>Die Ecken der Ansichten sind schwarz, %1 % ihrer Pixel, weil ein Objektiv sie abschneidet; sie sind als ungültig markiert.</translation>
    </message>
    <message>
        <source>The depth gives disparities of %1 … %2 px per view step, which is implausible; check dH, focalLength and shift of the file.</source>
        <translation>Die Tiefe ergibt Disparitäten von %1 … %2 px je Ansichtsschritt, was unplausibel ist; dH, focalLength und shift der Datei prüfen.</translation>
    </message>
    <message>
        <source>The depth of this file is no ground truth: it was %1.</source>
        <translation>Die Tiefe dieser Datei ist keine Referenz: %1.</translation>
    </message>
    <message>
        <source>The depth of this file was estimated.</source>
        <translation>Die Tiefe dieser Datei ist geschätzt.</translation>
    </message>
    <message>
        <source>The grid is subsampled: every %3th view</source>
        <translation>Das Gitter ist unterabgetastet: jede %3. Ansicht</translation>
    </message>
    <message>
        <source>The grid of %1×%2 views was inferred.</source>
        <translation>Das Gitter von %1×%2 Ansichten wurde erschlossen.</translation>
    </message>
    <message>
        <source>The ground truth could not be checked.</source>
        <translation>Die Referenz war nicht zu prüfen.</translation>
    </message>
    <message>
        <source>The ground truth hardly explains the views.</source>
        <translation>Die Referenz erklärt die Ansichten kaum.</translation>
    </message>
    <message>
        <source>The ground truth was turned.</source>
        <translation>Die Referenz wurde gedreht.</translation>
    </message>
    <message>
        <source>The last %4 columns and %5 rows of pixels are left out.</source>
        <translation>Die letzten %4 Spalten und %5 Zeilen von Pixeln bleiben aus.</translation>
    </message>
    <message>
        <source>The names number %1 %2: the grid is subsampled, and disparities are per %3 steps of the numbers.</source>
        <translation>Die Namen zählen %1 %2: Das Gitter ist unterabgetastet, und Disparitäten gelten je %3 Schritte der Nummern.</translation>
    </message>
    <message>
        <source>The names number %1 %2: they are taken for neighbors at equal distances.</source>
        <translation>Die Namen zählen %1 %2: Sie gelten als Nachbarn in gleichen Abständen.</translation>
    </message>
    <message>
        <source>The order of views is &quot;%1&quot; and not &quot;%2&quot;, which was expected because %3.</source>
        <translation>Die Reihenfolge der Ansichten ist „%1“ und nicht „%2“, wie zu erwarten war: %3.</translation>
    </message>
    <message>
        <source>The order of views was chosen by hand (%1), but the check favors &quot;%2&quot;.</source>
        <translation>Die Reihenfolge der Ansichten wurde von Hand gewählt (%1), die Prüfung spricht aber für „%2“.</translation>
    </message>
    <message>
        <source>The picture has %1×%2 px, which %3 does not divide: the last %4 columns and %5 rows of pixels are left out.</source>
        <translation>Das Bild hat %1×%2 px, die sich nicht durch %3 teilen lassen: Die letzten %4 Spalten und %5 Zeilen von Pixeln bleiben aus.</translation>
    </message>
    <message>
        <source>The poses of %1 are not used, as %2; the names and the views themselves tell rows and columns.</source>
        <translation>Die Posen von %1 werden nicht verwendet: %2; Namen und Ansichten selbst zeigen Zeilen und Spalten.</translation>
    </message>
    <message>
        <source>The poses of %1 are not used.</source>
        <translation>Die Posen von %1 werden nicht verwendet.</translation>
    </message>
    <message>
        <source>The views are those of %1; pictures in %2 are left out.</source>
        <translation>Die Ansichten sind die von %1; Bilder in %2 bleiben aus.</translation>
    </message>
    <message>
        <source>There is no parameters.cfg: the grid of %1×%2 views was inferred from the number of files.</source>
        <translation>Es gibt keine parameters.cfg: Das Gitter von %1×%2 Ansichten wurde aus der Zahl der Dateien erschlossen.</translation>
    </message>
    <message>
        <source>Using %5×%6 of %1×%2 views; others are missing.</source>
        <translation>Verwendet %5×%6 von %1×%2 Ansichten; andere fehlen.</translation>
    </message>
    <message>
        <source>Using the inner %1 of %2 views, rows %3 to %4 and columns %5 to %6 from 0: %7 outer views are dark (mean %8 % of the center&apos;s); --crop all keeps them.</source>
        <translation>Verwendet die inneren %1 von %2 Ansichten, Zeilen %3 bis %4 und Spalten %5 bis %6 ab 0: %7 äußere Ansichten sind dunkel (im Mittel %8 % der mittleren); --crop all behält sie.</translation>
    </message>
    <message>
        <source>Using the inner %1 of %2 views; the outer ones are dark.</source>
        <translation>Verwendet die inneren %1 von %2 Ansichten; die äußeren sind dunkel.</translation>
    </message>
    <message>
        <source>Views are numbered with gaps.</source>
        <translation>Ansichten sind mit Lücken nummeriert.</translation>
    </message>
    <message>
        <source>both rows and columns in reverse order</source>
        <translation>Zeilen und Spalten in umgekehrter Reihenfolge</translation>
    </message>
    <message>
        <source>brightness of the views, which differs by up to %1 %, was evened out</source>
        <translation>die Helligkeit der Ansichten, die sich um bis zu %1 % unterscheidet, wurde angeglichen</translation>
    </message>
    <message>
        <source>by occlusion: %1 points to %2, in %3 squares of the view to %4</source>
        <translation>durch Verdeckung: %1 Punkte gegen %2, in %3 Quadraten der Ansicht gegen %4</translation>
    </message>
    <message>
        <source>bytes less 128</source>
        <translation>Bytes minus 128</translation>
    </message>
    <message>
        <source>camDistance is ignored.</source>
        <translation>camDistance wird nicht verwendet.</translation>
    </message>
    <message>
        <source>cameras stand up to %1 steps off the regular grid, which this method takes for granted; net, plane_pm and stereo methods can use their positions</source>
        <translation>Kameras stehen bis zu %1 Schritte neben dem regelmäßigen Gitter, das dieses Verfahren voraussetzt; net, plane_pm und Stereoverfahren können ihre Positionen verwenden</translation>
    </message>
    <message>
        <source>checked by %1</source>
        <translation>geprüft: %1</translation>
    </message>
    <message>
        <source>checked by the slopes of horizontal and vertical EPIs: correlation %1 as stored at %2 points, so both axes agree</source>
        <translation>geprüft an den Steigungen waagerechter und senkrechter EPIs: Korrelation %1 wie gespeichert an %2 Punkten, also stimmen beide Achsen überein</translation>
    </message>
    <message>
        <source>checked by the slopes of horizontal and vertical EPIs: correlation %1 as stored at %2 points, so exactly one axis is reversed</source>
        <translation>geprüft an den Steigungen waagerechter und senkrechter EPIs: Korrelation %1 wie gespeichert an %2 Punkten, also ist genau eine Achse umgekehrt</translation>
    </message>
    <message>
        <source>columns from right to left</source>
        <translation>Spalten von rechts nach links</translation>
    </message>
    <message>
        <source>computed on %1</source>
        <translation>berechnet auf %1</translation>
    </message>
    <message>
        <source>computed on the CPU: %1</source>
        <translation>auf der CPU berechnet: %1</translation>
    </message>
    <message>
        <source>differs by up to %1 % (view %2: %3)</source>
        <translation>verschieden um bis zu %1 % (Ansicht %2: %3)</translation>
    </message>
    <message>
        <source>direction checked by %1</source>
        <translation>Richtung geprüft: %1</translation>
    </message>
    <message>
        <source>disparity range %1 … %2 px, found from the images</source>
        <translation>Disparitätsbereich %1 … %2 px, aus den Bildern ermittelt</translation>
    </message>
    <message>
        <source>ended early</source>
        <translation>vorzeitig beendet</translation>
    </message>
    <message>
        <source>evened out; it differed by up to %1 % (view %2: %3)</source>
        <translation>angeglichen; sie war um bis zu %1 % verschieden (Ansicht %2: %3)</translation>
    </message>
    <message>
        <source>global labeling: λ %1 per px, energy %2, gap %3 after %4 iterations</source>
        <translation>globales Labeling: λ %1 je px, Energie %2, Lücke %3 nach %4 Iterationen</translation>
    </message>
    <message>
        <source>global labeling: λ %1 per px, energy %2, gap %3 after %4 iterations (ended early)</source>
        <translation>globales Labeling: λ %1 je px, Energie %2, Lücke %3 nach %4 Iterationen (vorzeitig beendet)</translation>
    </message>
    <message>
        <source>largest relative duality gap %1</source>
        <translation>größte relative Dualitätslücke %1</translation>
    </message>
    <message>
        <source>matching cost capped at ε = %1</source>
        <translation>Vergleichskosten bei ε = %1 gekappt</translation>
    </message>
    <message>
        <source>matching cost uncapped</source>
        <translation>Vergleichskosten ohne Kappung</translation>
    </message>
    <message>
        <source>no depth edges with clear occlusion: %1 points for this order, %2 against</source>
        <translation>keine Tiefenkanten mit klarer Verdeckung: %1 Punkte für diese Reihenfolge, %2 dagegen</translation>
    </message>
    <message>
        <source>normalized in some way: 0.1 % of them are darker, 0.1 % brighter</source>
        <translation>irgendwie normiert: 0.1 % von ihnen sind dunkler, 0.1 % heller</translation>
    </message>
    <message>
        <source>the pictures of a file do not say how they are ordered</source>
        <translation>die Bilder einer Datei sagen nicht, wie sie geordnet sind</translation>
    </message>
    <message>
        <source>rows and columns follow from the names</source>
        <translation>Zeilen und Spalten folgen aus den Namen</translation>
    </message>
    <message>
        <source>the poses of the cameras say so</source>
        <translation>die Posen der Kameras sagen es so</translation>
    </message>
    <message>
        <source>mosaics hold rows and columns of views in order</source>
        <translation>Mosaike enthalten Zeilen und Spalten der Ansichten in richtiger Folge</translation>
    </message>
    <message>
        <source>benchmark folders store views in canonical order</source>
        <translation>Ordner des Benchmarks enthalten Ansichten in kanonischer Ordnung</translation>
    </message>
    <message>
        <source>arrays do not say how their views are ordered</source>
        <translation>Arrays sagen nicht, wie ihre Ansichten geordnet sind</translation>
    </message>
    <message>
        <source>not checked (a single view)</source>
        <translation>nicht geprüft (eine einzelne Ansicht)</translation>
    </message>
    <message>
        <source>not checked (motion between views does not tell rows from columns)</source>
        <translation>nicht geprüft (Bewegung zwischen Ansichten unterscheidet Zeilen nicht von Spalten)</translation>
    </message>
    <message>
        <source>not checked (one column of views)</source>
        <translation>nicht geprüft (eine Spalte von Ansichten)</translation>
    </message>
    <message>
        <source>not checked (one row of views)</source>
        <translation>nicht geprüft (eine Zeile von Ansichten)</translation>
    </message>
    <message>
        <source>not checked (too little depth or texture)</source>
        <translation>nicht geprüft (zu wenig Tiefe oder Textur)</translation>
    </message>
    <message>
        <source>occlusion cannot be seen in fewer than three views in a row</source>
        <translation>Verdeckung ist in weniger als drei Ansichten hintereinander nicht zu sehen</translation>
    </message>
    <message>
        <source>occlusion: %1 points to %2, in %3 squares of the view to %4</source>
        <translation>Verdeckung: %1 Punkte gegen %2, in %3 Quadraten der Ansicht gegen %4</translation>
    </message>
    <message>
        <source>of %1 views not known</source>
        <translation>von %1 Ansichten nicht bekannt</translation>
    </message>
    <message>
        <source>ordering violated by %1 % of the lines, %2 % before</source>
        <translation>%1 % der Linien verletzen die Ordnung, zuvor %2 %</translation>
    </message>
    <message>
        <source>positions of cameras not used: they make no grid</source>
        <translation>Kamerapositionen nicht verwendet: sie bilden kein Gitter</translation>
    </message>
    <message>
        <source>positions of cameras not used: up to %1 steps off the regular grid%2, they match no better than the grid</source>
        <translation>Kamerapositionen nicht verwendet: bis zu %1 Schritte neben dem regelmäßigen Gitter%2, sie passen nicht besser als das Gitter</translation>
    </message>
    <message>
        <source>positions of cameras used, up to %1 steps off the regular grid%2</source>
        <translation>Kamerapositionen verwendet, bis zu %1 Schritte neben dem regelmäßigen Gitter%2</translation>
    </message>
    <message>
        <source>rows and columns exchanged</source>
        <translation>Zeilen und Spalten vertauscht</translation>
    </message>
    <message>
        <source>rows from bottom to top</source>
        <translation>Zeilen von unten nach oben</translation>
    </message>
    <message>
        <source>the disparity range found, %1 … %2 px, ends where the search does, at ±%3 px: the scene may reach farther; give a range to search it</source>
        <translation>der ermittelte Disparitätsbereich, %1 … %2 px, endet mit der Suche bei ±%3 px: Die Szene kann weiter reichen; dann einen Bereich angeben</translation>
    </message>
    <message>
        <source>the order was chosen by hand</source>
        <translation>die Reihenfolge wurde von Hand gewählt</translation>
    </message>
    <message>
        <source>the same in all views</source>
        <translation>in allen Ansichten gleich</translation>
    </message>
    <message>
        <source>this warps the views onto each other best (%1 grey levels)</source>
        <translation>so werden die Ansichten am besten aufeinander verzerrt (%1 Graustufen)</translation>
    </message>
    <message>
        <source>too little to even it out</source>
        <translation>zu wenig, um sie anzugleichen</translation>
    </message>
    <message>
        <source>two layers in %1 % of the pixels</source>
        <translation>zwei Schichten in %1 % der Pixel</translation>
    </message>
    <message>
        <source>visibility: %1 of %2 rounds</source>
        <translation>Sichtbarkeit: %1 von %2 Runden</translation>
    </message>
    <message>
        <source>weights of %1, hash %2</source>
        <translation>Gewichte aus %1, Prüfsumme %2</translation>
    </message>
    <message>
        <source>“%1” is ignored.</source>
        <translation>„%1“ wird nicht verwendet.</translation>
    </message>
    <message>
        <source>%1 % of the depth map agree within 0.01 px with d = %2/Z %3 %4</source>
        <translation>%1 % der Tiefenkarte stimmen auf 0.01 px mit d = %2/Z %3 %4 überein</translation>
    </message>
    <message>
        <source>%1 %2: left out.</source>
        <translation>%1 %2 und wird ausgelassen.</translation>
    </message>
    <message>
        <source>%1 cannot be used.</source>
        <translation>%1 ist nicht verwendbar.</translation>
    </message>
    <message>
        <source>%1 cannot be used: %2. %3</source>
        <translation>%1 ist nicht verwendbar: %2. %3</translation>
    </message>
    <message>
        <source>%1 is %2 at %3 % of its pixels, which the views contradict (%4): no disparity is known there.</source>
        <translation>%1 ist an %3 % der Pixel %2, dem widersprechen die Ansichten (%4): Dort ist keine Disparität bekannt.</translation>
    </message>
    <message>
        <source>%1 is missing; add it</source>
        <translation>%1 fehlt; hinzufügen</translation>
    </message>
    <message>
        <source>%1 is not used (%2): save disparity in px per view step as .npy, .pfm or float .tif.</source>
        <translation>%1 wird nicht verwendet (%2): Disparität in px pro Ansichtsschritt als .npy, .pfm oder .tif mit Gleitkommazahlen speichern.</translation>
    </message>
    <message>
        <source>%1 is not used.</source>
        <translation>%1 wird nicht verwendet.</translation>
    </message>
    <message>
        <source>%1 is unknown at %3 % of the pixels.</source>
        <translation>%1 ist an %3 % der Pixel unbekannt.</translation>
    </message>
    <message>
        <source>%1 of %2 %3 are left out. %4.</source>
        <translation>%1 von %2 %3 bleiben aus. %4.</translation>
    </message>
    <message>
        <source>%1 of %2 is %3, but the views have %4 px; the size of the views is used.</source>
        <translation>%1 von %2 ist %3, die Ansichten haben aber %4 px; die Größe der Ansichten gilt.</translation>
    </message>
    <message>
        <source>%1 of %2 maps are left out.</source>
        <translation>%1 von %2 Karten bleiben aus.</translation>
    </message>
    <message>
        <source>%1 promises %2×%3 views, but the files are %4×%5; correct num_cams_x and num_cams_y.</source>
        <translation>%1 verspricht %2×%3 Ansichten, die Dateien sind aber %4×%5; num_cams_x und num_cams_y berichtigen.</translation>
    </message>
    <message>
        <source>%1: %2, which is not a number; it is not used.</source>
        <translation>%1: %2 ist keine Zahl und wird nicht verwendet.</translation>
    </message>
    <message>
        <source>%2×%3 views are promised, %4×%5 are there.</source>
        <translation>%2×%3 Ansichten sind versprochen, %4×%5 sind da.</translation>
    </message>
    <message>
        <source>A border of %1 px has one value only and counts as padding; %2×%3 px are used.</source>
        <translation>Ein Rand von %1 px hat nur einen Wert und gilt als Auffüllung; %2×%3 px werden verwendet.</translation>
    </message>
    <message>
        <source>All views state that they are stored %1 (Exif orientation %2): they are shown upright, with rows and columns of pixels to match.</source>
        <translation>Alle Ansichten geben an, dass sie anders gespeichert sind (%1, Exif-Orientierung %2): Sie werden aufrecht gezeigt, mit Pixelzeilen und -spalten dazu.</translation>
    </message>
    <message>
        <source>Black corners (%1 %) do not count.</source>
        <translation>Schwarze Ecken (%1 %) zählen nicht.</translation>
    </message>
    <message>
        <source>By its name %1 holds Y, Cb and Cr: they were taken as those of %2 and turned into colors.</source>
        <translation>Dem Namen nach enthält %1 Y, Cb und Cr: Sie gelten als die von %2 und wurden in Farben umgerechnet.</translation>
    </message>
    <message>
        <source>Dark picture %1</source>
        <translation>Dunkelbild %1</translation>
    </message>
    <message>
        <source>Frame %1 is missing.</source>
        <translation>Bild %1 fehlt.</translation>
    </message>
    <message>
        <source>Labels start at 0 in these files: all labels are raised by one, so that 0 means none.</source>
        <translation>In diesen Dateien beginnen Labels bei 0: Alle werden um eins erhöht, sodass 0 keines bedeutet.</translation>
    </message>
    <message>
        <source>Lenses are %1 px apart, not %2 px as the camera says.</source>
        <translation>Linsen liegen %1 px auseinander, nicht %2 px, wie die Kamera angibt.</translation>
    </message>
    <message>
        <source>No white picture: vignetting remains</source>
        <translation>Kein Weißbild: Vignettierung bleibt</translation>
    </message>
    <message>
        <source>Nor can %1 other views. %2</source>
        <translation>Ebenso %1 andere Ansichten. %2</translation>
    </message>
    <message>
        <source>Orientations (Exif) differ.</source>
        <translation>Orientierungen (Exif) unterscheiden sich.</translation>
    </message>
    <message>
        <source>Rows and columns may be exchanged.</source>
        <translation>Zeilen und Spalten sind vielleicht vertauscht.</translation>
    </message>
    <message>
        <source>The attribute %1 does not fit.</source>
        <translation>Das Attribut %1 passt nicht.</translation>
    </message>
    <message>
        <source>The attribute %1 says %2, but LF has %3 along that axis; the shape of LF is used.</source>
        <translation>Das Attribut %1 sagt %2, LF hat auf dieser Achse aber %3; die Form von LF gilt.</translation>
    </message>
    <message>
        <source>The camera is ignored.</source>
        <translation>Die Kamera wird nicht verwendet.</translation>
    </message>
    <message>
        <source>The camera of %1 is ignored: %2.</source>
        <translation>Die Kamera von %1 wird nicht verwendet: %2.</translation>
    </message>
    <message>
        <source>The conventions that you set for this file were not used: %1</source>
        <translation>Die Konventionen, die für diese Datei gesetzt wurden, galten nicht: %1</translation>
    </message>
    <message>
        <source>The file of %1 is ignored.</source>
        <translation>Die Datei von %1 wird nicht verwendet.</translation>
    </message>
    <message>
        <source>The file of %1 is ignored: %2.</source>
        <translation>Die Datei von %1 wird nicht verwendet: %2.</translation>
    </message>
    <message>
        <source>The film states that its pictures are stored %1 (Exif orientation %2): they are shown upright, with rows and columns of pixels to match.</source>
        <translation>Der Film gibt an, dass seine Bilder anders gespeichert sind (%1, Exif-Orientierung %2): Sie werden aufrecht gezeigt, mit Pixelzeilen und -spalten dazu.</translation>
    </message>
    <message>
        <source>The fourth channel is left out.</source>
        <translation>Der vierte Kanal bleibt aus.</translation>
    </message>
    <message>
        <source>The fourth channel of %1 is left out: it is no weight of pixels, for %2. If it is depth or disparity, store it as an array of its own, as disparity or depth.</source>
        <translation>Der vierte Kanal von %1 bleibt aus: Er ist kein Gewicht von Pixeln, denn %2. Ist er Tiefe oder Disparität, als eigenes Feld speichern, als disparity oder depth.</translation>
    </message>
    <message>
        <source>The frame number %1 is missing; frames are counted without it.</source>
        <translation>Bild Nummer %1 fehlt; gezählt wird ohne es.</translation>
    </message>
    <message>
        <source>The ground truth hardly explains the views: warped by it, they differ by %1 grey levels along %2, the other way by %3 and unwarped by %4; check it, and dH, focalLength and shift if it was stored as depth.</source>
        <translation>Die Referenz erklärt die Ansichten kaum: Nach ihr verzerrt weichen sie entlang %2 um %1 Graustufen ab, andersherum um %3 und unverzerrt um %4; sie prüfen, auch dH, focalLength und shift, falls sie als Tiefe gespeichert war.</translation>
    </message>
    <message>
        <source>The ground truth was stored with %1, as comparing it with the views shows; it was put right.</source>
        <translation>Die Referenz war gespeichert mit %1, wie der Vergleich mit den Ansichten zeigt; das ist berichtigt.</translation>
    </message>
    <message>
        <source>The image size of %2 is not used.</source>
        <translation>Die Bildgröße von %2 wird nicht verwendet.</translation>
    </message>
    <message>
        <source>The lenses were found %1 px apart, but according to its pitches of lenses and pixels the camera has them %2 px apart: check the white picture and the optics.</source>
        <translation>Gefunden wurden Linsen im Abstand von %1 px, nach den Maßen von Linsen und Pixeln hat die Kamera sie im Abstand von %2 px: Weißbild und Optik prüfen.</translation>
    </message>
    <message>
        <source>The maps of %1×%2 px are padded %3 with a constant; %4×%5 px are used.</source>
        <translation>Die Karten von %1×%2 px sind mit einer Konstante aufgefüllt (%3); %4×%5 px werden verwendet.</translation>
    </message>
    <message>
        <source>The pictures of the film were turned upright.</source>
        <translation>Die Bilder des Films wurden aufgerichtet.</translation>
    </message>
    <message>
        <source>The values of the ground truth could not be checked: they explain the views no better than one disparity for all, or better in few places only (where both differ, in %1 squares of the view, the truth leaves %2 % of the error and is better by %3 standard deviations of chance).</source>
        <translation>Die Werte der Referenz ließen sich nicht prüfen: Sie erklären die Ansichten nicht besser als eine einzige Disparität, oder nur an wenigen Stellen besser (wo beide sich unterscheiden, in %1 Quadraten der Ansicht, lässt die Referenz %2 % des Fehlers übrig und ist um %3 Standardabweichungen des Zufalls besser).</translation>
    </message>
    <message>
        <source>The views are %3.</source>
        <translation>Die Ansichten sind %3.</translation>
    </message>
    <message>
        <source>The views are not %1×%2, row by row, but %3: %4.</source>
        <translation>Die Ansichten sind nicht %1×%2, Zeile für Zeile, sondern %3: %4.</translation>
    </message>
    <message>
        <source>The views differ too little to tell rows from columns of views; if they are exchanged, state the axes as %1.</source>
        <translation>Die Ansichten unterscheiden sich zu wenig, um Zeilen von Spalten zu unterscheiden; sind sie vertauscht, die Achsen als %1 angeben.</translation>
    </message>
    <message>
        <source>The views state %1 different orientations (Exif), %2 of %3 orientation %4: all are taken as they are stored; if the camera was turned, turn the pictures before.</source>
        <translation>Die Ansichten nennen %1 verschiedene Orientierungen (Exif), %2 von %3 die Orientierung %4: Alle gelten, wie sie gespeichert sind; war die Kamera gedreht, die Bilder vorher drehen.</translation>
    </message>
    <message>
        <source>The views were turned upright.</source>
        <translation>Die Ansichten wurden aufgerichtet.</translation>
    </message>
    <message>
        <source>This container of a Lytro camera holds processed pictures, without what the sensor saw: %1. They are no views of a light field; episcope-cli decode writes them as files.</source>
        <translation>Dieser Container einer Lytro-Kamera enthält fertige Bilder ohne das, was der Sensor sah: %1. Sie sind keine Ansichten eines Lichtfelds; episcope-cli decode schreibt sie als Dateien.</translation>
    </message>
    <message>
        <source>White picture %1</source>
        <translation>Weißbild %1</translation>
    </message>
    <message>
        <source>Y, Cb, Cr are turned into colors.</source>
        <translation>Y, Cb, Cr werden in Farben umgerechnet.</translation>
    </message>
    <message>
        <source>Your conventions were not used.</source>
        <translation>Die gesetzten Konventionen galten nicht.</translation>
    </message>
    <message>
        <source>dark picture %1</source>
        <translation>Dunkelbild %1</translation>
    </message>
    <message>
        <source>disp_min and disp_max were negated.</source>
        <translation>disp_min und disp_max wurden negiert.</translation>
    </message>
    <message>
        <source>grey error %1 there, %2 elsewhere</source>
        <translation>Graufehler %1 dort, %2 anderswo</translation>
    </message>
    <message>
        <source>hide others in other views (grey error %1, the hidden ones %2, %3 pairs)</source>
        <translation>verdecken andere in anderen Ansichten (Graufehler %1, die verdeckten %2, %3 Paare)</translation>
    </message>
    <message>
        <source>it leads out of the picture</source>
        <translation>sie führt aus dem Bild hinaus</translation>
    </message>
    <message>
        <source>larger values are nearer, by %1</source>
        <translation>größere Werte sind näher, nach %1</translation>
    </message>
    <message>
        <source>larger values are nearer: they %1</source>
        <translation>größere Werte sind näher: sie %1</translation>
    </message>
    <message>
        <source>mean grey error of neighboring views after warping %1, unwarped %2</source>
        <translation>mittlerer Graufehler benachbarter Ansichten nach dem Verzerren %1, unverzerrt %2</translation>
    </message>
    <message>
        <source>mean grey error of neighboring views after warping %1, unwarped %2, with the values as stored %3</source>
        <translation>mittlerer Graufehler benachbarter Ansichten nach dem Verzerren %1, unverzerrt %2, mit den Werten wie gespeichert %3</translation>
    </message>
    <message>
        <source>no depth edges tell near from far: the sign is the one that leaves the views in the order in which they are stored</source>
        <translation>keine Tiefenkanten trennen nah von fern: Es gilt das Vorzeichen, bei dem die Ansichten in der gespeicherten Reihenfolge bleiben</translation>
    </message>
    <message>
        <source>propagated to all views from %1 of them</source>
        <translation>von %1 Ansichten auf alle übertragen</translation>
    </message>
    <message>
        <source>smaller values are nearer, by %1</source>
        <translation>kleinere Werte sind näher, nach %1</translation>
    </message>
    <message>
        <source>smaller values are nearer: they %1</source>
        <translation>kleinere Werte sind näher: sie %1</translation>
    </message>
    <message>
        <source>the camera follows from disparity and depth</source>
        <translation>die Kamera folgt aus Disparität und Tiefe</translation>
    </message>
    <message>
        <source>this view has %1, but %2 has %3</source>
        <translation>diese Ansicht hat %1, %2 aber %3</translation>
    </message>
    <message>
        <source>white picture %1</source>
        <translation>Weißbild %1</translation>
    </message>
    <message>
        <source>white picture %1 (%2) is the nearest of %3 to the raw picture (%4)</source>
        <translation>Weißbild %1 (%2) ist von %3 das nächste zum Rohbild (%4)</translation>
    </message>
    <message>
        <source>white picture %1 (%2); the raw picture has %3</source>
        <translation>Weißbild %1 (%2); das Rohbild hat %3</translation>
    </message>
    <message>
        <source>white picture: the one in the file of the raw picture</source>
        <translation>Weißbild: das in der Datei des Rohbilds</translation>
    </message>
    <message>
        <source>without a white picture the lenses were found in the raw picture itself, and their vignetting remains; give one with --white</source>
        <translation>ohne Weißbild wurden die Linsen im Rohbild selbst gefunden, ihre Vignettierung bleibt; mit --white eines angeben</translation>
    </message>
    <message>
        <source>%1 of %2 views are rendered so far; shown are the %3×%4 around the center. Read it again to see more; if the rendering was stopped, the same command in Blender continues it.</source>
        <translation>%1 von %2 Ansichten sind bisher gerendert; gezeigt werden die %3×%4 um die Mitte. Erneutes Lesen zeigt mehr; wurde das Rendern abgebrochen, setzt derselbe Befehl in Blender es fort.</translation>
    </message>
    <message>
        <source>%1 views are missing: %2</source>
        <translation>%1 Ansichten fehlen: %2</translation>
    </message>
    <message>
        <source>The views form a cross of row %1 and column %2 (%3): those of the %4, %5×%6, are opened, the %7 others are not used; a pattern with the number of the %8 instead of %9 opens these.</source>
        <translation>Die Ansichten bilden ein Kreuz aus Zeile %1 und Spalte %2 (%3): Die der %4, %5×%6, werden geöffnet, die %7 anderen nicht verwendet; ein Muster mit der Nummer der %8 statt %9 öffnet diese.</translation>
    </message>
    <message>
        <source>Using %3×%4 views; %1 of %2 are rendered so far.</source>
        <translation>%3×%4 Ansichten werden verwendet; %1 von %2 sind bisher gerendert.</translation>
    </message>
    <message>
        <source>Using the views of the %4 of a cross.</source>
        <translation>Die Ansichten der %4 eines Kreuzes werden verwendet.</translation>
    </message>
    <message>
        <source>archive (%1)</source>
        <translation>Archiv (%1)</translation>
    </message>
    <message>
        <source>brightness of the views evened: fall-off %1</source>
        <translation>Helligkeit der Ansichten angeglichen: Abfall %1</translation>
    </message>
    <message>
        <source>column</source>
        <translation>Spalte</translation>
    </message>
    <message>
        <source>column %1</source>
        <translation>Spalte %1</translation>
    </message>
    <message>
        <source>columns %1</source>
        <translation>Spalten %1</translation>
    </message>
    <message>
        <source>confidence is left out: it has values beyond 0 … 1</source>
        <translation>die Konfidenz bleibt aus: Sie hat Werte außerhalb von 0 … 1</translation>
    </message>
    <message>
        <source>image grid (%1)</source>
        <translation>Bildraster (%1)</translation>
    </message>
    <message>
        <source>mirrored</source>
        <translation>gespiegelt</translation>
    </message>
    <message>
        <source>mosaic of %1 views side by side (%2)</source>
        <translation>Mosaik von %1 Ansichten nebeneinander (%2)</translation>
    </message>
    <message>
        <source>mosaic of %1 views side by side, rows from the bottom (%2)</source>
        <translation>Mosaik von %1 Ansichten nebeneinander, Zeilen von unten (%2)</translation>
    </message>
    <message>
        <source>mosaic of lenslets of %1 px (%2)</source>
        <translation>Mosaik aus Linsen von %1 px (%2)</translation>
    </message>
    <message>
        <source>quilt of %1 tiles, a line of views from the bottom left (%2)</source>
        <translation>Quilt aus %1 Kacheln, eine Reihe von Ansichten von unten links (%2)</translation>
    </message>
    <message>
        <source>row</source>
        <translation>Zeile</translation>
    </message>
    <message>
        <source>row %1</source>
        <translation>Zeile %1</translation>
    </message>
    <message>
        <source>rows %1</source>
        <translation>Zeilen %1</translation>
    </message>
    <message>
        <source>scores in high resolution are left out: %1</source>
        <translation>Bewertungen in hoher Auflösung bleiben aus: %1</translation>
    </message>
    <message>
        <source>turned and mirrored</source>
        <translation>gedreht und gespiegelt</translation>
    </message>
    <message>
        <source>turned by a quarter to the left</source>
        <translation>um eine Vierteldrehung nach links gedreht</translation>
    </message>
    <message>
        <source>turned by a quarter to the right</source>
        <translation>um eine Vierteldrehung nach rechts gedreht</translation>
    </message>
    <message>
        <source>turned by half</source>
        <translation>um eine halbe Drehung gedreht</translation>
    </message>
    <message>
        <source>upside down and mirrored</source>
        <translation>kopfstehend und gespiegelt</translation>
    </message>
    <message>
        <source>view %1 is missing</source>
        <translation>Ansicht %1 fehlt</translation>
    </message>
    <message>
        <source>Nothing matches at disparities of %1 … %2 px: the images show %3 … %4 px; the range auto searches those</source>
        <translation>Bei Disparitäten von %1 … %2 px passt nichts zusammen: Die Bilder zeigen %3 … %4 px; der automatische Bereich sucht dort</translation>
    </message>
    <message>
        <source>Nothing matches between the views.</source>
        <translation>Zwischen den Ansichten passt nichts zusammen.</translation>
    </message>
    <message>
        <source>Nothing matches between the views: the disparities, looked for within %1 … %2 px, are guesses</source>
        <translation>Zwischen den Ansichten passt nichts zusammen: Die Disparitäten, gesucht in %1 … %2 px, sind geraten</translation>
    </message>
    <message>
        <source>Nothing matches in the range searched.</source>
        <translation>Im durchsuchten Bereich passt nichts zusammen.</translation>
    </message>
    <message>
        <source>The maps of %1×%2 px are taken for the middle of %3×%4 px, and judged there alone.</source>
        <translation>Die Karten von %1×%2 px gelten als Mitte von %3×%4 px und werden nur dort bewertet.</translation>
    </message>
    <message>
        <source>Unexpected order of views: %1.</source>
        <translation>Unerwartete Reihenfolge der Ansichten: %1.</translation>
    </message>
    <message>
        <source>%1 names none of the %2×%3 views; its labels are taken for the center view (%4).</source>
        <translation>%1 benennt keine der %2×%3 Ansichten; die Labels gelten für die mittlere Ansicht (%4).</translation>
    </message>
    <message>
        <source>%1 names none of the views; it is taken for the center view.</source>
        <translation>%1 benennt keine der Ansichten und gilt für die mittlere.</translation>
    </message>
    <message>
        <source>No pixel belongs to %1 in %2: the shapes are too small, outside of the picture, or covered.</source>
        <translation>Kein Pixel gehört zu %1 in %2: Die Formen sind zu klein, außerhalb des Bildes oder verdeckt.</translation>
    </message>
    <message>
        <source>No pixel belongs to %1.</source>
        <translation>Kein Pixel gehört zu %1.</translation>
    </message>
    <message>
        <source>The labels are taken in the order in which the views are shown.</source>
        <translation>Die Labels gelten in der Reihenfolge, in der die Ansichten gezeigt werden.</translation>
    </message>
    <message>
        <source>The views were read in another order than they are stored (%1); the labels are taken in the order in which the views are shown. --flip none reads the views as they are stored.</source>
        <translation>Die Ansichten wurden in anderer Reihenfolge gelesen, als sie gespeichert sind (%1); die Labels gelten in der Reihenfolge, in der die Ansichten gezeigt werden. --flip none liest die Ansichten, wie sie gespeichert sind.</translation>
    </message>
    <message>
        <source>disp_min %1 is not below disp_max %2 in %3; neither is used.</source>
        <translation>disp_min %1 liegt nicht unter disp_max %2 in %3; keines von beiden wird verwendet.</translation>
    </message>
    <message>
        <source>disp_min is not below disp_max.</source>
        <translation>disp_min liegt nicht unter disp_max.</translation>
    </message>
    <message>
        <source>%1 holds labels of %2×%3 px for views of %4×%5 px: rows and columns were exchanged.</source>
        <translation>%1 enthält Labels von %2×%3 px für Ansichten von %4×%5 px: Zeilen und Spalten wurden vertauscht.</translation>
    </message>
    <message>
        <source>%1 of the %2 labels lie only between others, as on smoothed (antialiased) edges: draw with a hard brush, or list the colors that count in a table.</source>
        <translation>%1 der %2 Labels liegen nur zwischen anderen, wie an geglätteten Kanten (Antialiasing): mit hartem Pinsel zeichnen, oder die Farben, die zählen, in einer Tabelle nennen.</translation>
    </message>
    <message>
        <source>%1 of the %2 labels may be smoothed edges.</source>
        <translation>%1 der %2 Labels sind vielleicht geglättete Kanten.</translation>
    </message>
    <message>
        <source>%1 px off the map of the center view on the average, as stored %2 px</source>
        <translation>im Mittel %1 px neben der Karte der mittleren Ansicht, wie gespeichert %2 px</translation>
    </message>
    <message>
        <source>%1 is normalized or lacks a constant.</source>
        <translation>%1 ist normiert oder ohne eine Konstante.</translation>
    </message>
    <message>
        <source>%1 were turned.</source>
        <translation>%1 wurden gedreht.</translation>
    </message>
    <message>
        <source>%1 with %2×%3 px lie on their side beside views of %4×%5 px: rows and columns were exchanged.</source>
        <translation>%1 mit %2×%3 px liegen neben Ansichten von %4×%5 px auf der Seite: Zeilen und Spalten wurden vertauscht.</translation>
    </message>
    <message>
        <source>No known unit explains the views well with %1: taken for %2, the next views differ by %3 grey levels, with its values times %4 plus %5 px by %6. If the map was normalized or shifted, save it again in px: no option undoes that.</source>
        <translation>Keine bekannte Einheit erklärt mit %1 die Ansichten gut: als %2 unterscheiden sich die nächsten Ansichten um %3 Graustufen, mit den Werten mal %4 plus %5 px um %6. Wurde die Karte normiert oder verschoben, sie noch einmal in px speichern: Keine Option macht das rückgängig.</translation>
    </message>
    <message>
        <source>No known unit explains the views well with %1: taken for %2, the next views differ by %3 grey levels, with its values times %4 by %5; if they are of another unit, convert the map to .pfm with --map-scale %6.</source>
        <translation>Keine bekannte Einheit erklärt mit %1 die Ansichten gut: als %2 unterscheiden sich die nächsten Ansichten um %3 Graustufen, mit den Werten mal %4 um %5; sind sie von anderer Einheit, die Karte mit --map-scale %6 in .pfm umwandeln.</translation>
    </message>
    <message>
        <source>The %1 of all views were reordered.</source>
        <translation>%1 aller Ansichten wurden umgeordnet.</translation>
    </message>
    <message>
        <source>The %1 of all views were stored in another order than the views (%2), as comparing them with views off the diagonal shows (%3); they were put right.</source>
        <translation>%1 aller Ansichten waren in anderer Reihenfolge gespeichert als die Ansichten (%2), wie der Vergleich mit Ansichten neben der Diagonalen zeigt (%3); das wurde berichtigt.</translation>
    </message>
    <message>
        <source>The labels of %1 were turned.</source>
        <translation>Die Labels von %1 wurden gedreht.</translation>
    </message>
    <message>
        <source>The unit of %1 is in doubt.</source>
        <translation>Die Einheit von %1 ist zweifelhaft.</translation>
    </message>
    <message>
        <source>There is a category 0 in this file: all labels are raised by one, so that 0 means none.</source>
        <translation>In dieser Datei gibt es eine Kategorie 0: alle Labels sind um eins erhöht, sodass 0 keines bedeutet.</translation>
    </message>
    <message>
        <source>These look like disparity maps of all views</source>
        <translation>Das sieht nach Disparitätskarten aller Ansichten aus</translation>
    </message>
    <message>
        <source>These look like disparity maps of all views: their values are no colors. To judge them, run evaluate %1 --truth INPUT, or put disparity into the name of the file.</source>
        <translation>Das sieht nach Disparitätskarten aller Ansichten aus: Die Werte sind keine Farben. Zum Beurteilen evaluate %1 --truth EINGABE aufrufen oder disparity in den Namen der Datei setzen.</translation>
    </message>
    <message>
        <source>contrast at their edges %1 grey levels, as stored %2</source>
        <translation>Kontrast an ihren Kanten %1 Graustufen, wie gespeichert %2</translation>
    </message>
    <message>
        <source>maps of the ground truth</source>
        <translation>Karten der Referenz</translation>
    </message>
    <message>
        <source>rows and columns of views exchanged</source>
        <translation>Zeilen und Spalten der Ansichten vertauscht</translation>
    </message>
    <message>
        <source>the disparity jumps by %1 px at their edges, as stored by %2</source>
        <translation>die Disparität springt an ihren Kanten um %1 px, wie gespeichert um %2</translation>
    </message>
    <message>
        <source>true labels</source>
        <translation>Labels der Referenz</translation>
    </message>
    <message>
        <source>%1 % of the white picture is saturated.</source>
        <translation>%1 % des Weißbilds sind gesättigt.</translation>
    </message>
    <message>
        <source>%1 % of the white picture is saturated: what the lenses shade is not known there. Expose it shorter.</source>
        <translation>%1 % des Weißbilds sind gesättigt: Was die Linsen dort abschatten, ist nicht bekannt. Kürzer belichten.</translation>
    </message>
    <message>
        <source>The raw picture shows its lenses %1 px from those of the white picture: it is of another camera or zoom, or the raw picture is too dark to tell.</source>
        <translation>Das Rohbild zeigt seine Linsen %1 px neben denen des Weißbilds: Es ist von einer anderen Kamera oder einem anderen Zoom, oder das Rohbild ist zu dunkel, um es zu erkennen.</translation>
    </message>
    <message>
        <source>The white picture has only %1 % of the light that the sensor can take, so its noise remains in the views. Expose it longer.</source>
        <translation>Das Weißbild hat nur %1 % des Lichts, das der Sensor fasst, sodass sein Rauschen in den Ansichten bleibt. Länger belichten.</translation>
    </message>
    <message>
        <source>The white picture is dark: %1 % of the range.</source>
        <translation>Das Weißbild ist dunkel: %1 % des Bereichs.</translation>
    </message>
    <message>
        <source>The white picture&apos;s lenses are %1 px off.</source>
        <translation>Die Linsen des Weißbilds liegen %1 px daneben.</translation>
    </message>
    <message>
        <source>colors were made neutral by the white picture: red times %1, blue times %2</source>
        <translation>Farben nach dem Weißbild neutral gemacht: Rot mal %1, Blau mal %2</translation>
    </message>
    <message>
        <source>samples of %1 bits, according to the largest one</source>
        <translation>Werte von %1 Bit, nach dem größten</translation>
    </message>
    <message>
        <source>white picture %1 (%2) is the nearest of %3 to the raw picture (%4), and better exposed than %5</source>
        <translation>Weißbild %1 (%2) ist von %3 das nächste zum Rohbild (%4) und besser belichtet als %5</translation>
    </message>
    <message>
        <source>decoded from %1: %2 lenses of %3 px, turned by %4°, views %5 px apart</source>
        <translation>dekodiert aus %1: Linsen von %3 px (%2), um %4° gedreht, Ansichten im Abstand von %5 px</translation>
    </message>
    <message>
        <source>The disparity holds values only where its mask is 0: the mask is taken for one of missing values, as NumPy writes them.</source>
        <translation>Die Disparität hat nur dort Werte, wo ihre Maske 0 ist: Die Maske gilt als Maske fehlender Werte, wie NumPy sie schreibt.</translation>
    </message>
    <message>
        <source>The mask marks missing values.</source>
        <translation>Die Maske markiert fehlende Werte.</translation>
    </message>
    <message>
        <source>%1 is named like a map and not used: it has %2, but maps of one view or of all %3×%4 views with %5×%6 px are expected.</source>
        <translation>%1 heißt wie eine Karte und wird nicht verwendet: vorhanden ist %2, erwartet werden Karten einer Ansicht oder aller %3×%4 Ansichten mit %5×%6 px.</translation>
    </message>
    <message>
        <source>%1 is not taken for true, since its name is that of an estimate; call it gt_… if it is true.</source>
        <translation>%1 gilt nicht als wahr, denn der Name ist der einer Schätzung; ist die Karte wahr, nennen Sie sie gt_….</translation>
    </message>
    <message>
        <source>%1 is not used: it has %2.</source>
        <translation>%1 wird nicht verwendet: vorhanden ist %2.</translation>
    </message>
    <message>
        <source>%1 is not used: its name is that of an estimate.</source>
        <translation>%1 wird nicht verwendet: der Name ist der einer Schätzung.</translation>
    </message>
    <message>
        <source>%1 is taken for true and %2 is not, though their names claim as much; rename or remove one of them if that is wrong.</source>
        <translation>%1 gilt als wahr und %2 nicht, obwohl die Namen gleich viel besagen; ist das falsch, benennen Sie eine der beiden um oder entfernen Sie sie.</translation>
    </message>
    <message>
        <source>%1 is used, %2 is not.</source>
        <translation>%1 wird verwendet, %2 nicht.</translation>
    </message>
    <message>
        <source>%1 leaves out %2 % of the ground truth.</source>
        <translation>%1 lässt %2 % der Referenz aus.</translation>
    </message>
    <message>
        <source>The %1 maps of %2 are taken for those of the views, row by row.</source>
        <translation>Die %1 Karten von %2 gelten als die der Ansichten, Zeile für Zeile.</translation>
    </message>
    <message>
        <source>The maps of %2 are taken row by row.</source>
        <translation>Die Karten von %2 gelten Zeile für Zeile.</translation>
    </message>
    <message>
        <source>%1 of %2 files %3 belong to no view by their numbers, such as %4: they are not used.</source>
        <translation>%1 von %2 Dateien %3 gehören nach ihren Nummern zu keiner Ansicht, etwa %4: sie werden nicht verwendet.</translation>
    </message>
    <message>
        <source>Every second %1 of views seems to be reversed.</source>
        <translation>Jede zweite %1 von Ansichten scheint umgekehrt zu sein.</translation>
    </message>
    <message>
        <source>The views of these maps seem to be stored in another order, %1: against the ground truth, MSE×100 is %2 so and %3 as read. Put the first two axes of the array in order.</source>
        <translation>Die Ansichten dieser Karten scheinen in anderer Reihenfolge gespeichert zu sein, %1: Gegen die wahre Disparität ist MSE×100 so %2 und wie gelesen %3. Ordnen Sie die ersten beiden Achsen des Arrays.</translation>
    </message>
    <message>
        <source>The maps seem to be of other views: %1.</source>
        <translation>Die Karten scheinen zu anderen Ansichten zu gehören: %1.</translation>
    </message>
    <message>
        <source>Rows of cameras are %1 times as far apart as columns.</source>
        <translation>Die Zeilen der Kameras liegen %1-mal so weit auseinander wie die Spalten.</translation>
    </message>
    <message>
        <source>Views %1 and %2 seem to be exchanged.</source>
        <translation>Die Ansichten %1 und %2 scheinen vertauscht zu sein.</translation>
    </message>
    <message>
        <source>Views %1 are the same picture.</source>
        <translation>Die Ansichten %1 sind dasselbe Bild.</translation>
    </message>
    <message>
        <source>%1 of %2 files %3 match no view.</source>
        <translation>%1 von %2 Dateien %3 passen zu keiner Ansicht.</translation>
    </message>
    <message>
        <source>Every second %1 of views seems to be stored the other way round: turned round, it differs from its neighbors by %2 % less. --snake reads images whose rows were captured back and forth; save other views again in order.</source>
        <translation>Jede zweite %1 der Ansichten scheint andersherum gespeichert zu sein: umgedreht unterscheidet sie sich um %2 % weniger von ihren Nachbarn. --snake liest Bilder, deren Zeilen hin und her aufgenommen wurden; andere Ansichten der Reihe nach neu speichern.</translation>
    </message>
    <message>
        <source>Rows of cameras are %1 times as far apart as columns, which no method takes into account: --crop 1x%2 reads a single row of views.</source>
        <translation>Die Zeilen der Kameras liegen %1-mal so weit auseinander wie die Spalten, was kein Verfahren berücksichtigt: --crop 1x%2 liest eine einzige Zeile von Ansichten.</translation>
    </message>
    <message>
        <source>Rows of cameras are %1 times as far apart as columns. net, plane_pm and stereo methods use the positions of the cameras; all others take both distances for equal, and their disparity is wrong: --crop 1x%2 reads a single row of views for them.</source>
        <translation>Die Zeilen der Kameras liegen %1-mal so weit auseinander wie die Spalten. net, plane_pm und Stereoverfahren verwenden die Positionen der Kameras; alle anderen halten beide Abstände für gleich, und ihre Disparität ist falsch: --crop 1x%2 liest für sie eine einzige Zeile von Ansichten.</translation>
    </message>
    <message>
        <source>Views %1 and %2 seem to stand in each other&apos;s place: exchanged, they differ from their neighbors by %3 % less. Rename or save them again in order.</source>
        <translation>Die Ansichten %1 und %2 scheinen vertauscht zu sein: getauscht unterscheiden sie sich um %3 % weniger von ihren Nachbarn. Benennen Sie sie um, oder speichern Sie sie der Reihe nach neu.</translation>
    </message>
    <message>
        <source>Views %1 are one and the same picture, stored more than once: replace what is wrong.</source>
        <translation>Die Ansichten %1 sind ein und dasselbe Bild, mehrfach gespeichert: Ersetzen Sie, was falsch ist.</translation>
    </message>
    <message>
        <source>by the camera poses, which define right and down</source>
        <translation>durch die Posen der Kameras, die rechts und unten festlegen</translation>
    </message>
    <message>
        <source>%1 promises disparities of %2 … %3 px, but the ground truth has %4 … %5 px; methods search what is promised unless the range is found or given.</source>
        <translation>%1 verspricht Disparitäten von %2 … %3 px, die Referenz hat aber %4 … %5 px; Verfahren durchsuchen das Versprochene, wenn der Bereich nicht gefunden oder angegeben wird.</translation>
    </message>
    <message>
        <source>%2 … %3 px are promised, the ground truth has %4 … %5 px.</source>
        <translation>%2 … %3 px sind versprochen, die Referenz hat %4 … %5 px.</translation>
    </message>
    <message>
        <source>*, placed by %1</source>
        <translation>*, angeordnet nach %1</translation>
    </message>
    <message>
        <source>The brightness of the views differs by up to %1 % (view %2: %3). Methods even it out; --equalize evens out the pictures, too, and --no-equalize leaves all as it is.</source>
        <translation>Die Helligkeit der Ansichten unterscheidet sich um bis zu %1 % (Ansicht %2: %3). Verfahren gleichen sie aus; --equalize gleicht auch die Bilder aus, und --no-equalize lässt alles, wie es ist.</translation>
    </message>
    <message>
        <source>array of %1</source>
        <translation>Array der Größe %1</translation>
    </message>
    <message>
        <source>by the ground truth, which is in doubt, mean grey error after warping: %1</source>
        <translation>nach der zweifelhaften Referenz, mittlerer Graufehler nach dem Verzerren: %1</translation>
    </message>
    <message>
        <source>by the ground truth: %1</source>
        <translation>durch die Referenz: %1</translation>
    </message>
    <message>
        <source>by the ground truth: mean grey error of neighboring views after warping %1, as stored %2</source>
        <translation>nach der Referenz: mittlerer Grauwertfehler benachbarter Ansichten nach dem Verschieben %1, wie gespeichert %2</translation>
    </message>
    <message>
        <source>checked against the ground truth, mean grey error after warping: %1</source>
        <translation>an der Referenz geprüft, mittlerer Graufehler nach dem Verzerren: %1</translation>
    </message>
    <message>
        <source>d = dH·focalLength/Z − shift with %1: %2 … %3 px for depth %4 … %5</source>
        <translation>d = dH·focalLength/Z − shift mit %1: %2 … %3 px für Tiefen von %4 … %5</translation>
    </message>
    <message>
        <source>dH and shift as stored</source>
        <translation>dH und shift wie gespeichert</translation>
    </message>
    <message>
        <source>dH and shift times xRes</source>
        <translation>dH und shift mal xRes</translation>
    </message>
    <message>
        <source>dH times xRes, shift as stored</source>
        <translation>dH mal xRes, shift wie gespeichert</translation>
    </message>
    <message>
        <source>disp_min and disp_max of %1 have the other sign than the ground truth, in which larger values are nearer; they were negated.</source>
        <translation>disp_min und disp_max von %1 haben das andere Vorzeichen als die Referenz, in der größere Werte näher sind; sie wurden negiert.</translation>
    </message>
    <message>
        <source>empty dataset</source>
        <translation>leerer Datensatz</translation>
    </message>
    <message>
        <source>has its samples in other files, which are not read</source>
        <translation>hat seine Werte in anderen Dateien, die nicht gelesen werden,</translation>
    </message>
    <message>
        <source>holds no numbers</source>
        <translation>enthält keine Zahlen</translation>
    </message>
    <message>
        <source>holds records of several fields (compound)</source>
        <translation>enthält Datensätze aus mehreren Feldern (compound)</translation>
    </message>
    <message>
        <source>is a link to another file, which is not followed</source>
        <translation>ist ein Verweis auf eine andere Datei, dem nicht gefolgt wird,</translation>
    </message>
    <message>
        <source>is a link to nothing</source>
        <translation>ist ein Verweis ins Leere</translation>
    </message>
    <message>
        <source>is empty</source>
        <translation>ist leer</translation>
    </message>
    <message>
        <source>the ground truth fits this order of views, and negated the opposite one; nothing tells which is right</source>
        <translation>die Referenz passt zu dieser Reihenfolge der Ansichten und negiert zur umgekehrten; nichts sagt, welche stimmt</translation>
    </message>
    <message>
        <source>the ground truth is in doubt</source>
        <translation>die Referenz ist zweifelhaft</translation>
    </message>
    <message>
        <source>the map explains little of the ground truth: MSE×100 %1 against %2 of the best constant map; check its scale, units and view</source>
        <translation>die Karte erklärt wenig von der Referenz: MSE×100 %1 gegen %2 der besten konstanten Karte; prüfen Sie Maßstab, Einheit und Ansicht</translation>
    </message>
    <message>
        <source>%1 holds labels of pictures that are no views of this light field; they are left out: %2.</source>
        <translation>%1 enthält Labels von Bildern, die keine Ansichten dieses Lichtfelds sind; sie bleiben weg: %2.</translation>
    </message>
    <message>
        <source>%1 is taken for view (%2), but its name may mean view (%3) as well; keep only the numbers of row and column in it, as in 03_04.png.</source>
        <translation>%1 gilt als Ansicht (%2), der Name kann aber auch Ansicht (%3) meinen; nur die Nummern von Zeile und Spalte darin lassen, wie in 03_04.png.</translation>
    </message>
    <message>
        <source>%1 is taken for view (%2).</source>
        <translation>%1 gilt als Ansicht (%2).</translation>
    </message>
    <message>
        <source>%1: 0 means unlabeled whatever is ignored (%2 % of the pixels); --first-label 0 makes it a label, and raises all ids by one.</source>
        <translation>%1: 0 heißt immer „ohne Label“ (%2 % der Pixel); --first-label 0 macht 0 zu einem Label und erhöht alle Nummern um eins.</translation>
    </message>
    <message>
        <source>0 means unlabeled.</source>
        <translation>0 heißt „ohne Label“.</translation>
    </message>
    <message>
        <source>Ids that other labels have, or above %1, became others: %2.</source>
        <translation>Nummern, die andere Labels haben oder die über %1 liegen, wurden ersetzt: %2.</translation>
    </message>
    <message>
        <source>Labels of one name or color are told apart in these files: %1.</source>
        <translation>Labels mit gleichem Namen oder gleicher Farbe sind in diesen Dateien unterschieden: %1.</translation>
    </message>
    <message>
        <source>Labels of one name or color were told apart.</source>
        <translation>Labels mit gleichem Namen oder gleicher Farbe wurden unterschieden.</translation>
    </message>
    <message>
        <source>Labels of other pictures in %1 are left out.</source>
        <translation>Labels anderer Bilder in %1 bleiben weg.</translation>
    </message>
    <message>
        <source>Some labels have other ids than in the file.</source>
        <translation>Einige Labels haben andere Nummern als in der Datei.</translation>
    </message>
    <message>
        <source>Processed pictures, no light field: %1</source>
        <translation>Fertige Bilder, kein Lichtfeld: %1</translation>
    </message>
</context>
<context>
    <name>episcope::FocusController</name>
    <message>
        <source>Apply focus plane</source>
        <translation>Fokusebene anwenden</translation>
    </message>
    <message>
        <source>Shifts all disparities, including results and ground truth, so that the focus plane has disparity 0</source>
        <translation>Verschiebt alle Disparitäten, auch die von Ergebnissen und Referenz, sodass scharf Gestelltes 0 hat</translation>
    </message>
    <message>
        <source>Ctrl+Alt+Return</source>
        <translation>Ctrl+Alt+Return</translation>
    </message>
    <message>
        <source>Undo applied focus plane</source>
        <translation>Angewandte Fokusebene zurücknehmen</translation>
    </message>
    <message>
        <source>Restores the disparities of the files</source>
        <translation>Stellt die Disparitäten der Dateien wieder her</translation>
    </message>
    <message>
        <source>A method is still running on this light field: wait for it to finish, or cancel it.</source>
        <translation>Auf diesem Lichtfeld läuft noch ein Verfahren: warten, bis es fertig ist, oder es abbrechen.</translation>
    </message>
    <message>
        <source>There are unsaved scribbles on this light field: save or undo them first.</source>
        <translation>Auf diesem Lichtfeld sind Striche nicht gespeichert: erst speichern oder zurücknehmen.</translation>
    </message>
    <message>
        <source>Results are still being moved to the focus plane: wait a moment.</source>
        <translation>Ergebnisse werden noch auf die Fokusebene verschoben: bitte einen Moment warten.</translation>
    </message>
</context>
<context>
    <name>episcope::Frame</name>
    <message>
        <source>All tabs</source>
        <translation>Alle Reiter</translation>
    </message>
    <message>
        <source>Below the other tabs</source>
        <translation>Unter die anderen Reiter</translation>
    </message>
    <message>
        <source>Detach into a window</source>
        <translation>In ein Fenster lösen</translation>
    </message>
</context>
<context>
    <name>episcope::FrameController</name>
    <message>
        <source>Next frame</source>
        <translation>Nächstes Einzelbild</translation>
    </message>
    <message>
        <source>Opens the next frame of the sequence</source>
        <translation>Öffnet das nächste Einzelbild der Sequenz</translation>
    </message>
    <message>
        <source>Alt+Right</source>
        <translation>Alt+Right</translation>
    </message>
    <message>
        <source>Previous frame</source>
        <translation>Voriges Einzelbild</translation>
    </message>
    <message>
        <source>Opens the previous frame of the sequence</source>
        <translation>Öffnet das vorige Einzelbild der Sequenz</translation>
    </message>
    <message>
        <source>Alt+Left</source>
        <translation>Alt+Left</translation>
    </message>
    <message>
        <source>Play frames</source>
        <translation>Sequenz abspielen</translation>
    </message>
    <message>
        <source>Plays the frames of the sequence, or pauses</source>
        <translation>Spielt die Einzelbilder der Sequenz ab oder hält an</translation>
    </message>
    <message>
        <source>Ctrl+Space</source>
        <translation>Ctrl+Space</translation>
    </message>
</context>
<context>
    <name>episcope::Help</name>
    <message>
        <source>About Episcope</source>
        <translation>Über Episcope</translation>
    </message>
    <message>
        <source>Keys and mouse</source>
        <translation>Tastatur und Maus</translation>
    </message>
    <message>
        <source>Lists every key and mouse gesture</source>
        <translation>Listet alle Tasten und Mausgesten auf</translation>
    </message>
    <message>
        <source>Find a command…</source>
        <translation>Befehl suchen…</translation>
    </message>
    <message>
        <source>Ctrl+Shift+P</source>
        <translation>Ctrl+Shift+P</translation>
    </message>
    <message>
        <source>&lt;b&gt;Episcope %1&lt;/b&gt;&lt;p&gt;Views, EPIs, disparity and labels of 4D light fields.&lt;/p&gt;&lt;p&gt;BSD 3-Clause license.&lt;/p&gt;</source>
        <translation>&lt;b&gt;Episcope %1&lt;/b&gt;&lt;p&gt;Ansichten, EPIs, Disparität und Labels von 4D-Lichtfeldern.&lt;/p&gt;&lt;p&gt;BSD-Lizenz (3 Klauseln).&lt;/p&gt;</translation>
    </message>
    <message>
        <source>Shows version and license</source>
        <translation>Zeigt Version und Lizenz</translation>
    </message>
    <message>
        <source>Manual</source>
        <translation>Handbuch</translation>
    </message>
    <message>
        <source>Opens the pages of the manual</source>
        <translation>Öffnet die Seiten des Handbuchs</translation>
    </message>
    <message>
        <source>Finds commands, methods, open and recent light fields by words of their names and descriptions</source>
        <translation>Findet Befehle, Verfahren, geöffnete und frühere Lichtfelder nach Wörtern ihrer Namen und Beschreibungen</translation>
    </message>
</context>
<context>
    <name>episcope::HistogramView</name>
    <message>
        <source>No visible values</source>
        <translation>Keine sichtbaren Werte</translation>
    </message>
    <message>
        <source>Visible values. Drag the handles to change the color range.</source>
        <translation>Sichtbare Werte. Die Griffe ziehen, um den Farbbereich zu ändern.</translation>
    </message>
</context>
<context>
    <name>episcope::ImportLabelsDialog</name>
    <message>
        <source>“0 is a label”</source>
        <translation>„0 ist ein Label“</translation>
    </message>
    <message>
        <source>0 is a label</source>
        <translation>0 ist ein Label</translation>
    </message>
    <message>
        <source>Raises all ids by one, so that 0 means none</source>
        <translation>Erhöht alle Nummern um eins, sodass 0 „kein Label“ heißt</translation>
    </message>
    <message>
        <source>Import labels</source>
        <translation>Labels importieren</translation>
    </message>
    <message>
        <source>255 where all labels are smaller</source>
        <translation>255, wo alle Labels kleiner sind</translation>
    </message>
    <message>
        <source>Ids between commas that mean “unlabeled”, besides 0; - for none</source>
        <translation>Nummern mit Kommas dazwischen, die außer 0 „ohne Label“ bedeuten; - für keine</translation>
    </message>
    <message>
        <source>Unlabeled</source>
        <translation>Ohne Label</translation>
    </message>
    <message>
        <source>As &amp;strokes: the segmentation is learned from them</source>
        <translation>Als &amp;Striche: Die Segmentierung lernt aus ihnen</translation>
    </message>
    <message>
        <source>As s&amp;egmentation: shown, checked and exported as labels</source>
        <translation>Als S&amp;egmentierung: gezeigt, geprüft und exportiert wie Labels</translation>
    </message>
    <message>
        <source>As &amp;true labels: the segmentation is compared with them</source>
        <translation>Als &amp;wahre Labels: Die Segmentierung wird mit ihnen verglichen</translation>
    </message>
    <message>
        <source>Import</source>
        <translation>Importieren</translation>
    </message>
    <message numerus="yes">
        <source>%n view(s) with labels. View %1: %2</source>
        <translation>
            <numerusform>%n Ansicht mit Labels. Ansicht %1: %2</numerusform>
            <numerusform>%n Ansichten mit Labels. Ansicht %1: %2</numerusform>
        </translation>
    </message>
    <message>
        <source>The labels shown now are replaced. A button in the message that follows brings them back.</source>
        <translation>Die gezeigten Labels werden ersetzt. Ein Knopf in der Meldung, die folgt, holt sie zurück.</translation>
    </message>
    <message>
        <source>Table…</source>
        <translation>Tabelle …</translation>
    </message>
    <message>
        <source>What the colors of pictures mean: lines r,g,b,id,name, or a labelmap.txt</source>
        <translation>Was die Farben von Bildern bedeuten: Zeilen r,g,b,id,name oder eine labelmap.txt</translation>
    </message>
    <message>
        <source>Colors</source>
        <translation>Farben</translation>
    </message>
    <message>
        <source>Table of colors</source>
        <translation>Farbtabelle</translation>
    </message>
    <message>
        <source>Tables (*.csv *.txt);;All files (*)</source>
        <translation>Tabellen (*.csv *.txt);;Alle Dateien (*)</translation>
    </message>
</context>
<context>
    <name>episcope::InfoController</name>
    <message>
        <source>Conventions…</source>
        <translation>Konventionen…</translation>
    </message>
    <message>
        <source>Overrides the detected order of views, units or file names</source>
        <translation>Legt die Reihenfolge der Ansichten, die Einheiten oder die Dateinamen anders als gefunden fest</translation>
    </message>
    <message>
        <source>Ctrl+Shift+R</source>
        <translation>Ctrl+Shift+R</translation>
    </message>
    <message>
        <source>Reverse near and far</source>
        <translation>Nah und fern vertauschen</translation>
    </message>
    <message>
        <source>Reverses the order of views along both axes, which swaps near and far</source>
        <translation>Kehrt die Reihenfolge der Ansichten in beiden Achsen um: was nah war, ist fern</translation>
    </message>
    <message>
        <source>Opening …</source>
        <translation>Wird geöffnet …</translation>
    </message>
    <message>
        <source>Nothing is open</source>
        <translation>Nichts geöffnet</translation>
    </message>
</context>
<context>
    <name>episcope::InfoPanel</name>
    <message>
        <source>RGB</source>
        <translation>RGB</translation>
    </message>
    <message>
        <source>grey</source>
        <translation>grau</translation>
    </message>
    <message>
        <source>, 8 bit</source>
        <translation>, 8 Bit</translation>
    </message>
    <message>
        <source>, 16 bit</source>
        <translation>, 16 Bit</translation>
    </message>
    <message>
        <source>, float</source>
        <translation>, Gleitkomma</translation>
    </message>
    <message>
        <source>, on disk</source>
        <translation>, auf der Platte</translation>
    </message>
    <message>
        <source>all views</source>
        <translation>alle Ansichten</translation>
    </message>
    <message>
        <source>%1 of %2 views</source>
        <translation>%1 von %2 Ansichten</translation>
    </message>
    <message>
        <source>disparity (%1)</source>
        <translation>Disparität (%1)</translation>
    </message>
    <message>
        <source>two layers</source>
        <translation>zwei Schichten</translation>
    </message>
    <message>
        <source>labels</source>
        <translation>Labels</translation>
    </message>
    <message>
        <source>1 region mask</source>
        <translation>1 Gebietsmaske</translation>
    </message>
    <message>
        <source>%1 region masks</source>
        <translation>%1 Gebietsmasken</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>B·f %1, shift %2 px</source>
        <translation>B·f %1, Versatz %2 px</translation>
    </message>
    <message>
        <source>, Z₀ %1</source>
        <translation>, Z₀ %1</translation>
    </message>
    <message>
        <source>%1 (set by you)</source>
        <translation>%1 (selbst gesetzt)</translation>
    </message>
    <message>
        <source>automatic</source>
        <translation>automatisch</translation>
    </message>
    <message>
        <source>, snake</source>
        <translation>, Schlangenlinie</translation>
    </message>
    <message>
        <source>%1, %2 of %3 GiB free</source>
        <translation>%1, %2 von %3 GiB frei</translation>
    </message>
    <message>
        <source>Order</source>
        <translation>Reihenfolge</translation>
    </message>
    <message>
        <source>Sign</source>
        <translation>Vorzeichen</translation>
    </message>
    <message>
        <source>not known</source>
        <translation>nicht bekannt</translation>
    </message>
    <message>
        <source>checked</source>
        <translation>geprüft</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Kamera</translation>
    </message>
    <message>
        <source>Depth</source>
        <translation>Tiefe</translation>
    </message>
    <message>
        <source>Format</source>
        <translation>Format</translation>
    </message>
    <message>
        <source>Views</source>
        <translation>Ansichten</translation>
    </message>
    <message>
        <source>%1×%2</source>
        <translation>%1×%2</translation>
    </message>
    <message>
        <source>Size</source>
        <translation>Größe</translation>
    </message>
    <message>
        <source>%1×%2 px, %3 MB</source>
        <translation>%1×%2 px, %3 MB</translation>
    </message>
    <message>
        <source>Samples</source>
        <translation>Samples</translation>
    </message>
    <message>
        <source>Valid</source>
        <translation>Gültig</translation>
    </message>
    <message>
        <source>The others are dark or empty and do not count.</source>
        <translation>Die anderen sind dunkel oder leer und zählen nicht.</translation>
    </message>
    <message>
        <source>Brightness</source>
        <translation>Helligkeit</translation>
    </message>
    <message>
        <source>Disparity</source>
        <translation>Disparität</translation>
    </message>
    <message>
        <source>%1 … %2 px</source>
        <translation>%1 … %2 px</translation>
    </message>
    <message>
        <source>Focus</source>
        <translation>Fokus</translation>
    </message>
    <message>
        <source>%1 px applied</source>
        <translation>%1 px angewandt</translation>
    </message>
    <message>
        <source>Ground truth</source>
        <translation>Referenz</translation>
    </message>
    <message>
        <source>Names</source>
        <translation>Namen</translation>
    </message>
    <message>
        <source>Files</source>
        <translation>Dateien</translation>
    </message>
    <message>
        <source>Source</source>
        <translation>Quelle</translation>
    </message>
    <message>
        <source>GPU</source>
        <translation>GPU</translation>
    </message>
    <message>
        <source>No light field</source>
        <translation>Kein Lichtfeld</translation>
    </message>
    <message>
        <source>All views but the center one are interpolated.</source>
        <translation>Alle Ansichten außer der mittleren sind interpoliert.</translation>
    </message>
    <message>
        <source>also at ten times the resolution</source>
        <translation>auch in zehnfacher Auflösung</translation>
    </message>
    <message>
        <source>unknown</source>
        <translation>unbekannt</translation>
    </message>
    <message>
        <source>There is disparity, but no depth.</source>
        <translation>Es gibt Disparität, aber keine Tiefe.</translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation>%1 %</translation>
    </message>
    <message>
        <source>searching …</source>
        <translation>wird gesucht …</translation>
    </message>
    <message>
        <source>More on %1</source>
        <translation>Mehr zu %1</translation>
    </message>
    <message>
        <source>Hide the evidence</source>
        <translation>Verbirgt den Beleg</translation>
    </message>
    <message>
        <source>Show the evidence</source>
        <translation>Zeigt den Beleg</translation>
    </message>
    <message>
        <source>not used: </source>
        <translation>nicht verwendet: </translation>
    </message>
</context>
<context>
    <name>episcope::JobCancel</name>
    <message>
        <source>%1 is at %2 %. Cancel again to end it.</source>
        <translation>%1 ist bei %2 %. Zum Beenden noch einmal abbrechen.</translation>
    </message>
    <message>
        <source>Cancel it</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>%1 was cancelled at %2 %.</source>
        <translation>%1 wurde bei %2 % abgebrochen.</translation>
    </message>
</context>
<context>
    <name>episcope::JobPanel</name>
    <message>
        <source>less than 1 s left</source>
        <translation>noch weniger als 1 s</translation>
    </message>
    <message>
        <source>about %1 s left</source>
        <translation>noch etwa %1 s</translation>
    </message>
    <message>
        <source>about %1 min left</source>
        <translation>noch etwa %1 min</translation>
    </message>
    <message>
        <source>about %1 h %2 min left</source>
        <translation>noch etwa %1 h %2 min</translation>
    </message>
    <message>
        <source>No jobs running</source>
        <translation>Keine laufenden Aufträge</translation>
    </message>
    <message>
        <source>Finish now and keep the result so far</source>
        <translation>Jetzt beenden und das bisherige Ergebnis behalten</translation>
    </message>
    <message>
        <source>Cancel this job</source>
        <translation>Diesen Auftrag abbrechen</translation>
    </message>
    <message>
        <source>waiting</source>
        <translation>wartet</translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation>%1 %</translation>
    </message>
    <message>
        <source>cancelling</source>
        <translation>wird abgebrochen</translation>
    </message>
    <message>
        <source>finishing</source>
        <translation>wird abgeschlossen</translation>
    </message>
</context>
<context>
    <name>episcope::Jobs</name>
    <message>
        <source>%1 failed: %2</source>
        <translation>%1 fehlgeschlagen: %2</translation>
    </message>
    <message>
        <source>%1. Set this in “Conventions…”.</source>
        <translation>%1. Einstellen lässt sich das in „Konventionen…“.</translation>
    </message>
    <message>
        <source>“%1: %2”</source>
        <translation>„%1: %2“</translation>
    </message>
    <message>
        <source>“%1”</source>
        <translation>„%1“</translation>
    </message>
</context>
<context>
    <name>episcope::LabelChoice</name>
    <message>
        <source>label %1</source>
        <translation>Label %1</translation>
    </message>
</context>
<context>
    <name>episcope::LabelController</name>
    <message>
        <source>Label %1</source>
        <translation>Label %1</translation>
    </message>
    <message>
        <source>Next label</source>
        <translation>Nächstes Label</translation>
    </message>
    <message>
        <source>Paints with the next label</source>
        <translation>Malt mit dem nächsten Label</translation>
    </message>
    <message>
        <source>Swap labels</source>
        <translation>Labels wechseln</translation>
    </message>
    <message>
        <source>Returns to the label used before</source>
        <translation>Kehrt zum vorher benutzten Label zurück</translation>
    </message>
    <message>
        <source>Add label</source>
        <translation>Label hinzufügen</translation>
    </message>
    <message>
        <source>Adds a label to name and paint with</source>
        <translation>Fügt ein Label hinzu, um es zu benennen und damit zu malen</translation>
    </message>
    <message>
        <source>Ctrl+Shift+N</source>
        <translation>Ctrl+Shift+N</translation>
    </message>
    <message>
        <source>Rename label</source>
        <translation>Label umbenennen</translation>
    </message>
    <message>
        <source>Renames the current label</source>
        <translation>Benennt das aktuelle Label um</translation>
    </message>
    <message>
        <source>Remove label</source>
        <translation>Label entfernen</translation>
    </message>
    <message>
        <source>Removes the current label and everything painted with it</source>
        <translation>Entfernt das aktuelle Label und alles damit Gemalte</translation>
    </message>
    <message>
        <source>The light field is still loading.</source>
        <translation>Das Lichtfeld wird noch geladen.</translation>
    </message>
    <message>
        <source>Open a light field to label it.</source>
        <translation>Zum Annotieren ein Lichtfeld öffnen.</translation>
    </message>
    <message>
        <source>“%1” is locked: unlock it to remove it.</source>
        <translation>„%1“ ist gesperrt: zum Entfernen entsperren.</translation>
    </message>
    <message>
        <source>Remove a label</source>
        <translation>Label entfernen</translation>
    </message>
    <message>
        <source>Remove “%1” and everything painted with it, on all views?</source>
        <translation>„%1“ und alles damit Gemalte in allen Ansichten entfernen?</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Change color…</source>
        <translation>Farbe ändern…</translation>
    </message>
    <message>
        <source>Changes the color of the current label</source>
        <translation>Ändert die Farbe des aktuellen Labels</translation>
    </message>
    <message>
        <source>Color of “%1”</source>
        <translation>Farbe von „%1“</translation>
    </message>
    <message>
        <source>Paints with the label at place %1 of the list, or gives it to the marked region in doubt</source>
        <translation>Malt mit dem Label an Stelle %1 der Liste oder gibt es der markierten zweifelhaften Region</translation>
    </message>
    <message>
        <source>Merge into…</source>
        <translation>Verbinden mit…</translation>
    </message>
    <message>
        <source>Gives everything painted with the current label to another one, and removes it</source>
        <translation>Gibt alles, was mit dem aktuellen Label gemalt ist, einem anderen und entfernt es</translation>
    </message>
    <message>
        <source>There is no label at place %1.</source>
        <translation>An Stelle %1 ist kein Label.</translation>
    </message>
    <message>
        <source>There is a label “%1” already: choose another name, or merge the two.</source>
        <translation>Es gibt schon ein Label „%1“: einen anderen Namen wählen oder beide verbinden.</translation>
    </message>
    <message>
        <source>“%1” is locked: unlock it to merge it.</source>
        <translation>„%1“ ist gesperrt: zum Verbinden entsperren.</translation>
    </message>
    <message>
        <source>Merge labels</source>
        <translation>Labels verbinden</translation>
    </message>
    <message>
        <source>Merge “%1” into:</source>
        <translation>„%1“ verbinden mit:</translation>
    </message>
    <message>
        <source>Change number…</source>
        <translation>Nummer ändern…</translation>
    </message>
    <message>
        <source>Gives the current label another number, in everything painted with it</source>
        <translation>Gibt dem aktuellen Label eine andere Nummer, in allem damit Gemalten</translation>
    </message>
    <message>
        <source>Move label up</source>
        <translation>Label nach oben</translation>
    </message>
    <message>
        <source>Moves the current label up in the list</source>
        <translation>Schiebt das aktuelle Label in der Liste nach oben</translation>
    </message>
    <message>
        <source>Alt+Up</source>
        <translation>Alt+Up</translation>
    </message>
    <message>
        <source>Move label down</source>
        <translation>Label nach unten</translation>
    </message>
    <message>
        <source>Moves the current label down in the list</source>
        <translation>Schiebt das aktuelle Label in der Liste nach unten</translation>
    </message>
    <message>
        <source>Alt+Down</source>
        <translation>Alt+Down</translation>
    </message>
    <message>
        <source>No labels yet. Add one for each kind of object, then paint a few strokes on the view.</source>
        <translation>Noch keine Labels. Für jede Art von Objekt eines hinzufügen, dann ein paar Striche auf die Ansicht malen.</translation>
    </message>
    <message>
        <source>“%1” is locked: unlock it to change its number.</source>
        <translation>„%1“ ist gesperrt: entsperren, um die Nummer zu ändern.</translation>
    </message>
    <message>
        <source>Change the number of a label</source>
        <translation>Nummer eines Labels ändern</translation>
    </message>
    <message>
        <source>Number of “%1”, from 1 to %2:</source>
        <translation>Nummer von „%1“, von 1 bis %2:</translation>
    </message>
    <message>
        <source>“%1” has the number %2: choose another one, or merge the two.</source>
        <translation>„%1“ hat die Nummer %2: eine andere wählen oder die beiden zusammenführen.</translation>
    </message>
</context>
<context>
    <name>episcope::LabelImporter</name>
    <message>
        <source>Import labels…</source>
        <translation>Labels importieren…</translation>
    </message>
    <message>
        <source>Reads labels of other tools, as strokes, as segmentation or as true labels</source>
        <translation>Liest Labels anderer Programme, als Striche, als Segmentierung oder als wahre Labels</translation>
    </message>
    <message>
        <source>Import labels</source>
        <translation>Labels importieren</translation>
    </message>
    <message>
        <source>Labels (*.h5 *.hdf5 *.png *.bmp *.tif *.tiff *.pgm *.npy *.npz *.mat *.json);;All files (*)</source>
        <translation>Labels (*.h5 *.hdf5 *.png *.bmp *.tif *.tiff *.pgm *.npy *.npz *.mat *.json);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Importing %1</source>
        <translation>Importieren von %1</translation>
    </message>
    <message>
        <source>Labels are now compared with %1</source>
        <translation>Labels werden nun mit %1 verglichen</translation>
    </message>
    <message>
        <source>%1 contains no new scribbles.</source>
        <translation>%1 enthält keine neuen Striche.</translation>
    </message>
    <message>
        <source>Imported: %1</source>
        <translation>Importiert: %1</translation>
    </message>
</context>
<context>
    <name>episcope::LabelLookController</name>
    <message>
        <source>areas</source>
        <translation>Flächen</translation>
    </message>
    <message>
        <source>contours</source>
        <translation>Konturen</translation>
    </message>
    <message>
        <source>areas and contours</source>
        <translation>Flächen und Konturen</translation>
    </message>
    <message>
        <source>%1 px painted on this view, %2 %</source>
        <translation>%1 px in dieser Ansicht bemalt, %2 %</translation>
    </message>
    <message>
        <source>Disparity %1 ± %2 px, from %3 to %4 px</source>
        <translation>Disparität %1 ± %2 px, von %3 bis %4 px</translation>
    </message>
    <message>
        <source>Hide label</source>
        <translation>Label ausblenden</translation>
    </message>
    <message>
        <source>Neither shows the current label nor paints over it</source>
        <translation>Das aktuelle Label wird weder gezeigt noch übermalt</translation>
    </message>
    <message>
        <source>Show only this label</source>
        <translation>Nur dieses Label zeigen</translation>
    </message>
    <message>
        <source>Hides all other labels; a second time shows them again</source>
        <translation>Blendet alle anderen Labels aus; noch einmal blendet alle ein</translation>
    </message>
    <message>
        <source>Lock label</source>
        <translation>Label sperren</translation>
    </message>
    <message>
        <source>The current label is neither painted nor painted over</source>
        <translation>Das aktuelle Label wird weder gemalt noch übermalt</translation>
    </message>
    <message>
        <source>Shift+V</source>
        <translation>Shift+V</translation>
    </message>
    <message>
        <source>Draw labels as areas, contours or both</source>
        <translation>Labels als Flächen, Konturen oder beides zeichnen</translation>
    </message>
    <message>
        <source>Draws strokes and segments as areas, as contours, or as faint areas with contours</source>
        <translation>Zeichnet Striche und Segmente als Flächen, als Konturen oder als blasse Flächen mit Konturen</translation>
    </message>
    <message>
        <source>Shift+C</source>
        <translation>Shift+C</translation>
    </message>
    <message>
        <source>Labels are drawn as %1.</source>
        <translation>Darstellung der Labels: %1.</translation>
    </message>
    <message>
        <source>Undo changed locked labels: %1. Redo restores them.</source>
        <translation>Rückgängig hat Gesperrtes geändert: %1. Wiederholen holt es zurück.</translation>
    </message>
    <message>
        <source>Redo changed locked labels: %1. Undo restores them.</source>
        <translation>Wiederholen hat Gesperrtes geändert: %1. Rückgängig holt es zurück.</translation>
    </message>
</context>
<context>
    <name>episcope::LabelPalette</name>
    <message>
        <source>Add a label</source>
        <translation>Label hinzufügen</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Hinzufügen</translation>
    </message>
    <message>
        <source>Rename this label</source>
        <translation>Dieses Label umbenennen</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>Umbenennen</translation>
    </message>
    <message>
        <source>Remove this label and everything painted with it (Delete)</source>
        <translation>Dieses Label und alles damit Gemalte entfernen (Entf)</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Labels</source>
        <translation>Labels</translation>
    </message>
    <message>
        <source>Hidden: click to show it</source>
        <translation>Ausgeblendet: klicken, um es einzublenden</translation>
    </message>
    <message>
        <source>Click to hide it</source>
        <translation>Klicken, um es auszublenden</translation>
    </message>
    <message>
        <source>hidden</source>
        <translation>ausgeblendet</translation>
    </message>
    <message>
        <source>shown</source>
        <translation>sichtbar</translation>
    </message>
    <message>
        <source>Locked: neither painted nor painted over. Click to unlock it</source>
        <translation>Gesperrt: wird weder gemalt noch übermalt. Klicken, um es zu entsperren</translation>
    </message>
    <message>
        <source>Click to lock it: it is then neither painted nor painted over</source>
        <translation>Klicken, um es zu sperren: es wird dann weder gemalt noch übermalt</translation>
    </message>
    <message>
        <source>locked</source>
        <translation>gesperrt</translation>
    </message>
    <message>
        <source>not locked</source>
        <translation>nicht gesperrt</translation>
    </message>
    <message>
        <source>Show</source>
        <translation>Einblenden</translation>
    </message>
    <message>
        <source>Hide</source>
        <translation>Ausblenden</translation>
    </message>
    <message>
        <source>Show only this</source>
        <translation>Nur dieses zeigen</translation>
    </message>
    <message>
        <source>Unlock</source>
        <translation>Entsperren</translation>
    </message>
    <message>
        <source>Lock</source>
        <translation>Sperren</translation>
    </message>
    <message>
        <source>Click to change the color of “%1”</source>
        <translation>Klicken, um die Farbe von „%1“ zu ändern</translation>
    </message>
    <message>
        <source>Change color…</source>
        <translation>Farbe ändern…</translation>
    </message>
    <message>
        <source>Filter by name or number</source>
        <translation>Nach Name oder Nummer filtern</translation>
    </message>
    <message>
        <source>Filter of labels</source>
        <translation>Filter der Labels</translation>
    </message>
    <message>
        <source>Change number…</source>
        <translation>Nummer ändern…</translation>
    </message>
    <message>
        <source>Move up</source>
        <translation>Nach oben</translation>
    </message>
    <message>
        <source>Move down</source>
        <translation>Nach unten</translation>
    </message>
    <message>
        <source>Merge into…</source>
        <translation>Verbinden mit…</translation>
    </message>
</context>
<context>
    <name>episcope::LabelReviewController</name>
    <message>
        <source>Check</source>
        <translation>Prüfen</translation>
    </message>
    <message>
        <source>Check tab</source>
        <translation>Reiter Prüfen</translation>
    </message>
    <message>
        <source>Shows where labels are in doubt, their islands and holes</source>
        <translation>Zeigt, wo Labels zweifelhaft sind, und ihre Inseln und Löcher</translation>
    </message>
    <message>
        <source>“%1”</source>
        <translation>„%1“</translation>
    </message>
    <message>
        <source>Next region in doubt</source>
        <translation>Nächstes zweifelhaftes Gebiet</translation>
    </message>
    <message>
        <source>Goes to the places where a stroke decides most: large regions with another label nearly as probable</source>
        <translation>Geht dorthin, wo ein Strich am meisten entscheidet: zu großen Gebieten, für die ein anderes Label fast ebenso wahrscheinlich ist</translation>
    </message>
    <message>
        <source>Previous region in doubt</source>
        <translation>Voriges zweifelhaftes Gebiet</translation>
    </message>
    <message>
        <source>Goes back to the previous region in doubt</source>
        <translation>Geht zum zweifelhaften Gebiet davor zurück</translation>
    </message>
    <message>
        <source>Shift+J</source>
        <translation>Shift+J</translation>
    </message>
    <message>
        <source>label %1</source>
        <translation>Label %1</translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation>%1 %</translation>
    </message>
    <message>
        <source>Disparity in px per view: %1 ± %2 (mean and standard deviation), from %3 to %4</source>
        <translation>Disparität in px je Ansicht: %1 ± %2 (Mittel und Standardabweichung), von %3 bis %4</translation>
    </message>
    <message>
        <source>Nothing is segmented yet: paint two labels, then update the segmentation.</source>
        <translation>Noch ist nichts segmentiert: zwei Labels malen, dann die Segmentierung aktualisieren.</translation>
    </message>
    <message>
        <source>Islands and holes</source>
        <translation>Inseln und Löcher</translation>
    </message>
    <message>
        <source>hole</source>
        <translation>Loch</translation>
    </message>
    <message>
        <source>island</source>
        <translation>Insel</translation>
    </message>
    <message>
        <source>Islands and holes of %1</source>
        <translation>Inseln und Löcher von %1</translation>
    </message>
    <message>
        <source>No region of this view is in doubt.</source>
        <translation>Kein Gebiet dieser Ansicht ist zweifelhaft.</translation>
    </message>
    <message>
        <source>%1 of %2: %3 pixels of %4 may be %5. A stroke here decides; Return keeps the label, 1 … 9 give it another.</source>
        <translation>%1 von %2: %3 Pixel von %4 sind vielleicht %5. Ein Strich hier entscheidet; Eingabe behält das Label, 1 … 9 geben ein anderes.</translation>
    </message>
</context>
<context>
    <name>episcope::LabelReviewPanel</name>
    <message>
        <source>Regions in doubt</source>
        <translation>Zweifelhafte Gebiete</translation>
    </message>
    <message>
        <source>Label</source>
        <translation>Label</translation>
    </message>
    <message>
        <source>or perhaps</source>
        <translation>oder vielleicht</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>Pixel</translation>
    </message>
    <message>
        <source>Labels of this view</source>
        <translation>Labels dieser Ansicht</translation>
    </message>
    <message>
        <source>Share</source>
        <translation>Anteil</translation>
    </message>
    <message>
        <source>Mean</source>
        <translation>Mittel</translation>
    </message>
    <message>
        <source>Min</source>
        <translation>Min</translation>
    </message>
    <message>
        <source>Max</source>
        <translation>Max</translation>
    </message>
    <message>
        <source>Islands</source>
        <translation>Inseln</translation>
    </message>
    <message>
        <source>Holes</source>
        <translation>Löcher</translation>
    </message>
    <message>
        <source>Islands and holes</source>
        <translation>Inseln und Löcher</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>Art</translation>
    </message>
    <message>
        <source>Where a stroke would help most</source>
        <translation>Wo ein Strich am meisten hilft</translation>
    </message>
</context>
<context>
    <name>episcope::LabelScores</name>
    <message>
        <source>correct: %1 of this view</source>
        <translation>richtig: %1 dieser Ansicht</translation>
    </message>
    <message>
        <source>%1 near boundaries</source>
        <translation>%1 nahe Grenzen</translation>
    </message>
    <message>
        <source>mean IoU %1</source>
        <translation>mittlere IoU %1</translation>
    </message>
    <message>
        <source>%1 of all</source>
        <translation>%1 von allen</translation>
    </message>
    <message>
        <source>labels matched by overlap</source>
        <translation>Labels nach Überdeckung zugeordnet</translation>
    </message>
    <message>
        <source>consistent: %1</source>
        <translation>konsistent: %1</translation>
    </message>
</context>
<context>
    <name>episcope::LabelingSource</name>
    <message>
        <source>automatic</source>
        <translation>automatisch</translation>
    </message>
    <message>
        <source>none, images only</source>
        <translation>keine, nur Bilder</translation>
    </message>
    <message>
        <source>the ground truth</source>
        <translation>Referenz (Ground Truth)</translation>
    </message>
    <message>
        <source>Disparity for labels</source>
        <translation>Disparität für die Labels</translation>
    </message>
</context>
<context>
    <name>episcope::Language</name>
    <message>
        <source>The window will be in this language when Episcope starts again.</source>
        <translation>Das Fenster erscheint in dieser Sprache, wenn Episcope neu gestartet wird.</translation>
    </message>
    <message>
        <source>Follow the desktop</source>
        <translation>Wie die Arbeitsumgebung</translation>
    </message>
    <message>
        <source>The language of the desktop</source>
        <translation>Die Sprache der Arbeitsumgebung</translation>
    </message>
    <message>
        <source>Shows the window in %1</source>
        <translation>Zeigt das Fenster auf %1</translation>
    </message>
</context>
<context>
    <name>episcope::Layout</name>
    <message>
        <source>Full screen</source>
        <translation>Vollbild</translation>
    </message>
    <message>
        <source>Turns full screen on or off</source>
        <translation>Füllt den Bildschirm mit dem Fenster oder gibt ihn wieder frei</translation>
    </message>
    <message>
        <source>Side panels</source>
        <translation>Seitenleisten</translation>
    </message>
    <message>
        <source>Shows the views at the left and the tabs at the right; without them, the view has all the room</source>
        <translation>Zeigt links die Ansichten und rechts die Reiter; ohne sie hat die Ansicht den ganzen Platz</translation>
    </message>
    <message>
        <source>Shift+F11</source>
        <translation>Shift+F11</translation>
    </message>
    <message>
        <source>Tab in its own window</source>
        <translation>Reiter im eigenen Fenster</translation>
    </message>
    <message>
        <source>Detaches the current tab, as a double click on it does; close its window to dock it again</source>
        <translation>Gibt dem angezeigten Reiter ein eigenes Fenster; es zu schließen holt ihn zurück. Ein Doppelklick auf den Reiter tut dasselbe</translation>
    </message>
    <message>
        <source>Horizontal EPI in its own window</source>
        <translation>Horizontales EPI im eigenen Fenster</translation>
    </message>
    <message>
        <source>Detaches the horizontal EPI into its own window, or docks it again</source>
        <translation>Gibt dem horizontalen EPI ein eigenes Fenster oder holt es zurück</translation>
    </message>
    <message>
        <source>Vertical EPI in its own window</source>
        <translation>Vertikales EPI im eigenen Fenster</translation>
    </message>
    <message>
        <source>Detaches the vertical EPI into its own window, or docks it again</source>
        <translation>Gibt dem vertikalen EPI ein eigenes Fenster oder holt es zurück</translation>
    </message>
    <message>
        <source>Reset layout</source>
        <translation>Anordnung zurücksetzen</translation>
    </message>
    <message>
        <source>Docks all panes and restores the default layout</source>
        <translation>Holt alle Teilfenster zurück und teilt das Fenster ein wie am Anfang</translation>
    </message>
    <message>
        <source>Ctrl+Shift+F11</source>
        <translation>Ctrl+Shift+F11</translation>
    </message>
    <message>
        <source>Tab below the others</source>
        <translation>Reiter unter die anderen</translation>
    </message>
    <message>
        <source>Moves the current tab into a second set of tabs below the others; its cross moves it back</source>
        <translation>Legt den gezeigten Reiter zu den Reitern unter den anderen, so dass beide zu sehen sind; sein Kreuz bringt ihn zurück</translation>
    </message>
    <message>
        <source>Shift+F6</source>
        <translation>Shift+F6</translation>
    </message>
    <message>
        <source>Horizontal EPI below the tabs</source>
        <translation>Horizontales EPI unter die Reiter</translation>
    </message>
    <message>
        <source>Moves the horizontal EPI into the tabs below the others, or back</source>
        <translation>Legt das horizontale EPI zu den Reitern unter den anderen oder holt es zurück</translation>
    </message>
    <message>
        <source>Shift+F7</source>
        <translation>Shift+F7</translation>
    </message>
    <message>
        <source>Vertical EPI below the tabs</source>
        <translation>Vertikales EPI unter die Reiter</translation>
    </message>
    <message>
        <source>Moves the vertical EPI into the tabs below the others, or back</source>
        <translation>Legt das vertikale EPI zu den Reitern unter den anderen oder holt es zurück</translation>
    </message>
    <message>
        <source>Shift+F8</source>
        <translation>Shift+F8</translation>
    </message>
</context>
<context>
    <name>episcope::LiveController</name>
    <message>
        <source>%1 ms</source>
        <translation>%1 ms</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>Live estimate</source>
        <translation>Live-Schätzung</translation>
    </message>
    <message>
        <source>Estimates the visible part after every change of parameters or view; Run keeps the result</source>
        <translation>Schätzt das Sichtbare bei jeder Änderung von Parametern oder Ansicht; Starten behält es</translation>
    </message>
    <message>
        <source>Ctrl+L</source>
        <translation>Ctrl+L</translation>
    </message>
    <message>
        <source>Live %1</source>
        <translation>Live %1</translation>
    </message>
    <message>
        <source>Live</source>
        <translation>Live</translation>
    </message>
    <message>
        <source>Live: %1</source>
        <translation>Live: %1</translation>
    </message>
    <message>
        <source>Live: coarse %1 / </source>
        <translation>Live: grob %1 / </translation>
    </message>
    <message>
        <source>Live: </source>
        <translation>Live: </translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation>%1 %</translation>
    </message>
    <message>
        <source>full %1</source>
        <translation>voll %1</translation>
    </message>
    <message>
        <source>Live: this method has no map of this view</source>
        <translation>Live: dieses Verfahren hat keine Karte dieser Ansicht</translation>
    </message>
</context>
<context>
    <name>episcope::MainWindow</name>
    <message>
        <source>Ctrl+%1</source>
        <translation>Ctrl+%1</translation>
    </message>
    <message>
        <source>Main tool bar</source>
        <translation>Hauptwerkzeugleiste</translation>
    </message>
</context>
<context>
    <name>episcope::ManualWindow</name>
    <message>
        <source>Page of the manual</source>
        <translation>Seite des Handbuchs</translation>
    </message>
    <message>
        <source>Contents</source>
        <translation>Inhalt</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Zurück</translation>
    </message>
    <message>
        <source>The pages of the manual are not installed with the program, in share/episcope/manual. Install it anew.</source>
        <translation>Die Seiten des Handbuchs fehlen in share/episcope/manual. Das Programm neu installieren.</translation>
    </message>
    <message>
        <source>Manual</source>
        <translation>Handbuch</translation>
    </message>
    <message>
        <source>%1 — Manual</source>
        <translation>%1 – Handbuch</translation>
    </message>
    <message>
        <source>No paragraph has all of these words.</source>
        <translation>Kein Absatz enthält alle diese Wörter.</translation>
    </message>
    <message>
        <source>Search: %1</source>
        <translation>Suche: %1</translation>
    </message>
    <message>
        <source>Search the manual</source>
        <translation>Handbuch durchsuchen</translation>
    </message>
</context>
<context>
    <name>episcope::MeasureController</name>
    <message>
        <source>row %1</source>
        <translation>Zeile %1</translation>
    </message>
    <message>
        <source>column %1</source>
        <translation>Spalte %1</translation>
    </message>
    <message>
        <source>%1 px per view, measured in %2 at pixel x %3, y %4 of view (%5, %6). A click goes there.</source>
        <translation>%1 px je Ansicht, gemessen in %2 an Pixel x %3, y %4 der Ansicht (%5, %6). Ein Klick führt dorthin.</translation>
    </message>
    <message>
        <source>Measure</source>
        <translation>Messen</translation>
    </message>
    <message>
        <source>Measure tab</source>
        <translation>Reiter Messen</translation>
    </message>
    <message>
        <source>Lists the disparities measured in EPIs</source>
        <translation>Listet die in EPIs gemessenen Disparitäten auf</translation>
    </message>
    <message>
        <source>Keep the measured line</source>
        <translation>Gemessene Linie behalten</translation>
    </message>
    <message>
        <source>Keeps the disparity of the line drawn in an EPI in the list of the Measure tab</source>
        <translation>Behält die Disparität der in einem EPI gezogenen Linie in der Liste des Reiters Messen</translation>
    </message>
    <message>
        <source>Ctrl+K</source>
        <translation>Ctrl+K</translation>
    </message>
    <message>
        <source>Rename the chosen measurement</source>
        <translation>Gewählte Messung umbenennen</translation>
    </message>
    <message>
        <source>Renames the chosen measured line</source>
        <translation>Benennt die in der Liste gewählte gemessene Linie um</translation>
    </message>
    <message>
        <source>Remove the chosen measurement</source>
        <translation>Gewählte Messung entfernen</translation>
    </message>
    <message>
        <source>Removes the chosen measured line</source>
        <translation>Entfernt die gewählte gemessene Linie aus der Liste</translation>
    </message>
    <message>
        <source>Copy measurements as CSV</source>
        <translation>Messungen als CSV kopieren</translation>
    </message>
    <message>
        <source>Copies all measured lines as a table</source>
        <translation>Kopiert alle gemessenen Linien als Tabelle</translation>
    </message>
    <message>
        <source>Saves all measured lines as a table (CSV)</source>
        <translation>Speichert alle gemessenen Linien als Tabelle (CSV)</translation>
    </message>
    <message>
        <source>Focus on the chosen measurement</source>
        <translation>Auf gewählte Messung fokussieren</translation>
    </message>
    <message>
        <source>Moves the focus plane to the measured disparity</source>
        <translation>Verschiebt die Fokusebene auf die gemessene Disparität</translation>
    </message>
    <message>
        <source>Drag along a line in an EPI to measure its disparity, then keep it (%1).</source>
        <translation>In einem EPI entlang einer Linie ziehen, um ihre Disparität zu messen, und sie dann behalten (%1).</translation>
    </message>
    <message>
        <source>Measured disparity: %1 px per view; %2 keeps it</source>
        <translation>Gemessene Disparität: %1 px je Ansicht; %2 behält sie</translation>
    </message>
    <message>
        <source>line %1</source>
        <translation>Linie %1</translation>
    </message>
    <message>
        <source>Nothing is measured: drag along a line in an EPI first.</source>
        <translation>Noch nichts gemessen: erst in einem EPI entlang einer Linie ziehen.</translation>
    </message>
    <message numerus="yes">
        <source>%n measured line(s) copied as CSV.</source>
        <translation>
            <numerusform>%n gemessene Linie als CSV kopiert.</numerusform>
            <numerusform>%n gemessene Linien als CSV kopiert.</numerusform>
        </translation>
    </message>
    <message>
        <source>Save the measurements</source>
        <translation>Messungen speichern</translation>
    </message>
    <message>
        <source>CSV (*.csv)</source>
        <translation>CSV (*.csv)</translation>
    </message>
    <message>
        <source>Measurements…</source>
        <translation>Messungen…</translation>
    </message>
</context>
<context>
    <name>episcope::MeasurePanel</name>
    <message>
        <source>Measured lines</source>
        <translation>Gemessene Linien</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Disparity</source>
        <translation>Disparität</translation>
    </message>
    <message>
        <source>Depth</source>
        <translation>Tiefe</translation>
    </message>
    <message>
        <source>Place</source>
        <translation>Ort</translation>
    </message>
</context>
<context>
    <name>episcope::MeasuredRange</name>
    <message>
        <source>Disparity range of the next run: %1 … %2 px</source>
        <translation>Disparitätsbereich des nächsten Laufs: %1 … %2 px</translation>
    </message>
    <message>
        <source>Use the chosen measurement as minimum</source>
        <translation>Bereich beginnt an der gewählten Messung</translation>
    </message>
    <message>
        <source>Makes the chosen measured line the lower end of the disparity range of the method</source>
        <translation>Macht die gewählte gemessene Linie zum unteren Ende des Disparitätsbereichs des Verfahrens</translation>
    </message>
    <message>
        <source>Use the chosen measurement as maximum</source>
        <translation>Bereich endet an der gewählten Messung</translation>
    </message>
    <message>
        <source>Makes the chosen measured line the upper end of the disparity range of the method</source>
        <translation>Macht die gewählte gemessene Linie zum oberen Ende des Disparitätsbereichs des Verfahrens</translation>
    </message>
</context>
<context>
    <name>episcope::Menu</name>
    <message>
        <source>File</source>
        <translation>Datei</translation>
    </message>
    <message>
        <source>View</source>
        <translation>Ansicht</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>Sprache</translation>
    </message>
    <message>
        <source>Panes</source>
        <translation>Teilfenster</translation>
    </message>
    <message>
        <source>Estimate</source>
        <translation>Schätzen</translation>
    </message>
    <message>
        <source>Compare</source>
        <translation>Vergleichen</translation>
    </message>
    <message>
        <source>Annotate</source>
        <translation>Annotieren</translation>
    </message>
    <message>
        <source>Segmentation</source>
        <translation>Segmentierung</translation>
    </message>
    <message>
        <source>Help</source>
        <translation>Hilfe</translation>
    </message>
    <message>
        <source>Other views</source>
        <translation>Andere Ansichten</translation>
    </message>
    <message>
        <source>Measurements</source>
        <translation>Messungen</translation>
    </message>
    <message>
        <source>Tabs</source>
        <translation>Reiter</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Öffnen</translation>
    </message>
    <message>
        <source>Project</source>
        <translation>Projekt</translation>
    </message>
    <message>
        <source>Export</source>
        <translation>Exportieren</translation>
    </message>
    <message>
        <source>Map</source>
        <translation>Karte</translation>
    </message>
    <message>
        <source>Labels</source>
        <translation>Labels</translation>
    </message>
    <message>
        <source>Theme</source>
        <translation>Farbschema</translation>
    </message>
</context>
<context>
    <name>episcope::MeshResults</name>
    <message>
        <source>Depth of the mesh</source>
        <translation>Tiefe des Netzes</translation>
    </message>
    <message>
        <source>Skipped without a mesh or a pose: %1.</source>
        <translation>Ohne Netz oder Pose ausgelassen: %1.</translation>
    </message>
</context>
<context>
    <name>episcope::MeshShelf</name>
    <message>
        <source>Opening %1</source>
        <translation>Öffnen von %1</translation>
    </message>
</context>
<context>
    <name>episcope::MessageBar</name>
    <message>
        <source>Close this message</source>
        <translation>Diese Meldung schließen</translation>
    </message>
    <message>
        <source>Copy message</source>
        <translation>Meldung kopieren</translation>
    </message>
</context>
<context>
    <name>episcope::Messages</name>
    <message>
        <source>Saved: %1</source>
        <translation>Geschrieben: %1</translation>
    </message>
</context>
<context>
    <name>episcope::MethodPanel</name>
    <message>
        <source>All views</source>
        <translation>Alle Ansichten</translation>
    </message>
    <message>
        <source>Run</source>
        <translation>Starten</translation>
    </message>
    <message>
        <source>Estimate with these parameters</source>
        <translation>Mit diesen Parametern schätzen</translation>
    </message>
    <message>
        <source>Live</source>
        <translation>Live</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Cancel all runs</source>
        <translation>Alle Läufe abbrechen</translation>
    </message>
    <message>
        <source>Reset</source>
        <translation>Zurücksetzen</translation>
    </message>
    <message>
        <source>Reset all parameters to their defaults</source>
        <translation>Alle Parameter auf ihre Standardwerte zurücksetzen</translation>
    </message>
    <message>
        <source>Copy as command</source>
        <translation>Als Befehl kopieren</translation>
    </message>
    <message>
        <source>Copy the equivalent episcope-cli command</source>
        <translation>Den entsprechenden Befehl für episcope-cli kopieren</translation>
    </message>
    <message>
        <source>Estimation method</source>
        <translation>Schätzverfahren</translation>
    </message>
    <message>
        <source>Estimate all views instead of the center view only</source>
        <translation>Alle Ansichten schätzen statt nur der mittleren</translation>
    </message>
</context>
<context>
    <name>episcope::MethodRuns</name>
    <message>
        <source>New result: %1</source>
        <translation>Neues Ergebnis: %1</translation>
    </message>
    <message>
        <source>Show</source>
        <translation>Zeigen</translation>
    </message>
    <message>
        <source>%1: %2.</source>
        <translation>%1: %2.</translation>
    </message>
</context>
<context>
    <name>episcope::MetricController</name>
    <message>
        <source>Copied the numbers of one result as %1</source>
        <translation>Zahlen eines Ergebnisses als %1 kopiert</translation>
    </message>
    <message>
        <source>Copied the numbers of %1 results as %2</source>
        <translation>Zahlen von %1 Ergebnissen als %2 kopiert</translation>
    </message>
    <message>
        <source>This light field has no ground truth to compare results with.</source>
        <translation>Dieses Lichtfeld hat keine Referenz (Ground Truth), mit der sich Ergebnisse vergleichen ließen.</translation>
    </message>
    <message>
        <source>Open a light field with ground truth and run a method.</source>
        <translation>Ein Lichtfeld mit Referenz (Ground Truth) öffnen und ein Verfahren ausführen.</translation>
    </message>
    <message>
        <source>Run a method: its errors against the ground truth appear here.</source>
        <translation>Ein Verfahren ausführen: seine Fehler gegenüber der Referenz erscheinen hier.</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>Ergebnis</translation>
    </message>
    <message>
        <source>Name of the result</source>
        <translation>Name des Ergebnisses</translation>
    </message>
    <message>
        <source>Time
s</source>
        <translation>Zeit
s</translation>
    </message>
    <message>
        <source>Seconds taken</source>
        <translation>Benötigte Sekunden</translation>
    </message>
    <message>
        <source>Evaluated on</source>
        <translation>Bewertet</translation>
    </message>
    <message>
        <source>Scene</source>
        <translation>Szene</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>Verfahren</translation>
    </message>
    <message>
        <source>Parameters</source>
        <translation>Parameter</translation>
    </message>
    <message>
        <source>Ended early</source>
        <translation>Vorzeitig beendet</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>Pixel</translation>
    </message>
    <message>
        <source>Pixels that were evaluated</source>
        <translation>Pixel des bewerteten Teils</translation>
    </message>
    <message>
        <source>Pixels
2016</source>
        <translation>Pixel
2016</translation>
    </message>
    <message>
        <source>Evaluated pixels without the border of 15 px that this protocol ignores</source>
        <translation>Jene ohne den Rand von 15 px, den dieses Protokoll außer Acht lässt</translation>
    </message>
    <message>
        <source>yes</source>
        <translation>ja</translation>
    </message>
    <message>
        <source>no</source>
        <translation>nein</translation>
    </message>
    <message>
        <source>Save the table</source>
        <translation>Tabelle speichern</translation>
    </message>
    <message>
        <source>CSV (*.csv)</source>
        <translation>CSV (*.csv)</translation>
    </message>
    <message>
        <source>LaTeX (*.tex)</source>
        <translation>LaTeX (*.tex)</translation>
    </message>
    <message>
        <source>Table of metrics (CSV)…</source>
        <translation>Tabelle der Maße (CSV)…</translation>
    </message>
    <message>
        <source>Writes the metrics of all results with every column, as numbers for a program</source>
        <translation>Schreibt die Maße aller Ergebnisse mit allen Spalten, als Zahlen für ein Programm</translation>
    </message>
    <message>
        <source>Table of metrics (LaTeX)…</source>
        <translation>Tabelle der Maße (LaTeX)…</translation>
    </message>
    <message>
        <source>Writes the metrics of all results as they are shown, as a LaTeX table</source>
        <translation>Schreibt die Maße aller Ergebnisse, wie sie gezeigt werden, als LaTeX-Tabelle</translation>
    </message>
</context>
<context>
    <name>episcope::MetricTable</name>
    <message>
        <source>MSE×100</source>
        <translation>MSE×100</translation>
    </message>
    <message>
        <source>Mean squared error ×100, px²</source>
        <translation>Mittlerer quadratischer Fehler ×100, px²</translation>
    </message>
    <message>
        <source>bad .07</source>
        <translation>schl. .07</translation>
    </message>
    <message>
        <source>Pixels off by more than 0.07 px, in %</source>
        <translation>Um mehr als 0.07 px falsche Pixel, in %</translation>
    </message>
    <message>
        <source>bad .03</source>
        <translation>schl. .03</translation>
    </message>
    <message>
        <source>Pixels off by more than 0.03 px, in %</source>
        <translation>Um mehr als 0.03 px falsche Pixel, in %</translation>
    </message>
    <message>
        <source>bad .01</source>
        <translation>schl. .01</translation>
    </message>
    <message>
        <source>Pixels off by more than 0.01 px, in %</source>
        <translation>Um mehr als 0.01 px falsche Pixel, in %</translation>
    </message>
    <message>
        <source>Q25</source>
        <translation>Q25</translation>
    </message>
    <message>
        <source>Error ×100 below which the best quarter of the pixels lies, px</source>
        <translation>Fehler ×100, unter dem das beste Viertel der Pixel liegt, px</translation>
    </message>
    <message>
        <source>dense</source>
        <translation>dicht</translation>
    </message>
    <message>
        <source>Pixels with a value, in %</source>
        <translation>Pixel mit einem Wert, in %</translation>
    </message>
    <message>
        <source>shown</source>
        <translation>gezeigt</translation>
    </message>
    <message>
        <source>Pixels with ground truth that the light field shows, in %</source>
        <translation>Pixel mit Referenz, die das Lichtfeld zeigt, in %</translation>
    </message>
    <message>
        <source>MSE inner</source>
        <translation>MSE innen</translation>
    </message>
    <message>
        <source>Mean squared error ×100 without a border of 15 px, px²</source>
        <translation>Mittlerer quadratischer Fehler ×100 ohne einen Rand von 15 px, px²</translation>
    </message>
    <message>
        <source>edges</source>
        <translation>Kanten</translation>
    </message>
    <message>
        <source>Pixels at depth edges off by more than 0.07 px, in %</source>
        <translation>Um mehr als 0.07 px falsche Pixel an Tiefenkanten, in %</translation>
    </message>
    <message>
        <source>bumps pl.</source>
        <translation>Beulen Eb.</translation>
    </message>
    <message>
        <source>Bumpiness of planes ×100</source>
        <translation>Unebenheit von Ebenen ×100</translation>
    </message>
    <message>
        <source>bumps sm.</source>
        <translation>Beulen gl.</translation>
    </message>
    <message>
        <source>Bumpiness of smooth surfaces ×100</source>
        <translation>Unebenheit glatter Flächen ×100</translation>
    </message>
    <message>
        <source>angle pl.</source>
        <translation>Winkel Eb.</translation>
    </message>
    <message>
        <source>Median angular error of normals on planes, °</source>
        <translation>Median des Winkelfehlers der Normalen auf Ebenen, °</translation>
    </message>
    <message>
        <source>angle sm.</source>
        <translation>Winkel gl.</translation>
    </message>
    <message>
        <source>Median angular error of normals on smooth surfaces, °</source>
        <translation>Median des Winkelfehlers der Normalen auf glatten Flächen, °</translation>
    </message>
    <message>
        <source>fattened</source>
        <translation>verdickt</translation>
    </message>
    <message>
        <source>Pixels around fine structures that are more than 0.15 px too near, in %</source>
        <translation>Pixel um feine Strukturen, die mehr als 0.15 px zu nah sind, in %</translation>
    </message>
    <message>
        <source>thinned</source>
        <translation>verdünnt</translation>
    </message>
    <message>
        <source>Pixels of fine structures that are more than 0.15 px too far, in %</source>
        <translation>Pixel feiner Strukturen, die mehr als 0.15 px zu fern sind, in %</translation>
    </message>
    <message>
        <source>fattening</source>
        <translation>Verdickung</translation>
    </message>
    <message>
        <source>Pixels beside the foreground that are closer to it than to their background, in %</source>
        <translation>Pixel neben dem Vordergrund, die ihm näher sind als ihrem Hintergrund, in %</translation>
    </message>
    <message>
        <source>thinning</source>
        <translation>Verdünnung</translation>
    </message>
    <message>
        <source>Pixels of the foreground that are closer to the background than to it, in %</source>
        <translation>Pixel des Vordergrunds, die dem Hintergrund näher sind als ihm, in %</translation>
    </message>
    <message>
        <source>missed dots</source>
        <translation>fehl. Punkte</translation>
    </message>
    <message>
        <source>Dots with at least half of their pixels off by more than 0.4 px, in %</source>
        <translation>Punkte, von denen mindestens die Hälfte der Pixel um mehr als 0.4 px falsch ist, in %</translation>
    </message>
    <message>
        <source>MSE backgr.</source>
        <translation>MSE Hintergr.</translation>
    </message>
    <message>
        <source>Mean squared error ×100 of the background between dots, px²</source>
        <translation>Mittlerer quadratischer Fehler ×100 des Hintergrunds zwischen Punkten, px²</translation>
    </message>
    <message>
        <source>low texture</source>
        <translation>wenig Textur</translation>
    </message>
    <message>
        <source>Pixels without much texture off by more than 0.07 px, in %</source>
        <translation>Um mehr als 0.07 px falsche Pixel mit wenig Textur, in %</translation>
    </message>
    <message>
        <source>dark str.</source>
        <translation>dunkle Str.</translation>
    </message>
    <message>
        <source>Pixels of dark stripes, of high contrast, off by more than 0.07 px, in %</source>
        <translation>Um mehr als 0.07 px falsche Pixel dunkler Streifen hohen Kontrasts, in %</translation>
    </message>
    <message>
        <source>bright str.</source>
        <translation>helle Str.</translation>
    </message>
    <message>
        <source>Pixels of bright stripes, of low contrast, off by more than 0.07 px, in %</source>
        <translation>Um mehr als 0.07 px falsche Pixel heller Streifen geringen Kontrasts, in %</translation>
    </message>
    <message>
        <source>bumps sl.</source>
        <translation>Beulen schr.</translation>
    </message>
    <message>
        <source>Bumpiness of slanted surfaces ×100</source>
        <translation>Unebenheit schräger Flächen ×100</translation>
    </message>
    <message>
        <source>bumps par.</source>
        <translation>Beulen par.</translation>
    </message>
    <message>
        <source>Bumpiness of surfaces parallel to the image ×100</source>
        <translation>Unebenheit bildparalleler Flächen ×100</translation>
    </message>
    <message>
        <source>log time</source>
        <translation>log Zeit</translation>
    </message>
    <message>
        <source>Decadic logarithm of the seconds taken</source>
        <translation>Dekadischer Logarithmus der benötigten Sekunden</translation>
    </message>
    <message>
        <source>layers</source>
        <translation>Schichten</translation>
    </message>
    <message>
        <source>Pixels with the correct number of layers, one or two, in %</source>
        <translation>Pixel mit der richtigen Anzahl von Schichten, einer oder zwei, in %</translation>
    </message>
    <message>
        <source>front</source>
        <translation>vorn</translation>
    </message>
    <message>
        <source>Of the surface in front</source>
        <translation>Der Fläche im Vordergrund</translation>
    </message>
    <message>
        <source>behind</source>
        <translation>dahinter</translation>
    </message>
    <message>
        <source>low res.</source>
        <translation>ger. Aufl.</translation>
    </message>
    <message>
        <source>In the resolution of the views: the official score needs the truth of ten times the resolution</source>
        <translation>In der Auflösung der Ansichten: die offizielle Wertung braucht die Referenz in zehnfacher Auflösung</translation>
    </message>
    <message>
        <source>2013</source>
        <translation>2013</translation>
    </message>
    <message>
        <source>2016</source>
        <translation>2016</translation>
    </message>
    <message>
        <source>Metrics appear here once there is a result and a ground truth.</source>
        <translation>Fehlermaße erscheinen hier, sobald es ein Ergebnis und eine Referenz gibt.</translation>
    </message>
    <message>
        <source>Copy as CSV (Ctrl+C)</source>
        <translation>Als CSV kopieren (Strg+C)</translation>
    </message>
    <message>
        <source>CSV</source>
        <translation>CSV</translation>
    </message>
    <message>
        <source>Copy as LaTeX</source>
        <translation>Als LaTeX kopieren</translation>
    </message>
    <message>
        <source>LaTeX</source>
        <translation>LaTeX</translation>
    </message>
    <message>
        <source>Save as CSV or LaTeX</source>
        <translation>Als CSV oder LaTeX speichern</translation>
    </message>
    <message>
        <source>Save…</source>
        <translation>Speichern…</translation>
    </message>
    <message>
        <source>CSV…</source>
        <translation>CSV…</translation>
    </message>
    <message>
        <source>LaTeX…</source>
        <translation>LaTeX…</translation>
    </message>
    <message>
        <source>Metrics of all results</source>
        <translation>Fehlermaße aller Ergebnisse</translation>
    </message>
    <message>
        <source>Copy</source>
        <translation>Kopieren</translation>
    </message>
    <message>
        <source>Best of this column</source>
        <translation>Bester Wert dieser Spalte</translation>
    </message>
    <message>
        <source>Copy as CSV</source>
        <translation>Als CSV kopieren</translation>
    </message>
    <message>
        <source>Show</source>
        <translation>Anzeigen</translation>
    </message>
    <message>
        <source>Compare with</source>
        <translation>Vergleichen mit</translation>
    </message>
    <message>
        <source>present</source>
        <translation>vorhandene</translation>
    </message>
    <message>
        <source>Of the pixels that have a value; else missing values count as the farthest true disparity</source>
        <translation>Nur Pixel mit einem Wert; sonst zählen fehlende Werte als die fernste wahre Disparität</translation>
    </message>
    <message>
        <source>Protocol vmv2013: all pixels with ground truth, center view</source>
        <translation>Protokoll vmv2013: alle Pixel mit Referenz, mittlere Ansicht</translation>
    </message>
    <message>
        <source>Protocol benchmark2016: without a border of 15 px, center view</source>
        <translation>Protokoll benchmark2016: ohne einen Rand von 15 px, mittlere Ansicht</translation>
    </message>
    <message>
        <source>Columns</source>
        <translation>Spalten</translation>
    </message>
    <message>
        <source>Of the background seen through it</source>
        <translation>Des Hintergrunds, der hindurch zu sehen ist</translation>
    </message>
</context>
<context>
    <name>episcope::MovieExport</name>
    <message>
        <source>Save a movie</source>
        <translation>Film speichern</translation>
    </message>
    <message>
        <source>Parallax, refocusing or flips as MP4, WebM or GIF</source>
        <translation>Parallaxe, Refokussieren oder Umschalten als MP4, WebM oder GIF</translation>
    </message>
    <message>
        <source>Ctrl+Shift+M</source>
        <translation>Ctrl+Shift+M</translation>
    </message>
    <message>
        <source>Save the movie</source>
        <translation>Film speichern</translation>
    </message>
    <message>
        <source>MP4 (*.mp4);;WebM (*.webm);;GIF (*.gif)</source>
        <translation>MP4 (*.mp4);;WebM (*.webm);;GIF (*.gif)</translation>
    </message>
    <message>
        <source>Movie…</source>
        <translation>Film…</translation>
    </message>
</context>
<context>
    <name>episcope::MoviePanel</name>
    <message>
        <source>With the overlay of the view</source>
        <translation>Mit dem, was über der Ansicht liegt</translation>
    </message>
    <message>
        <source>Save…</source>
        <translation>Speichern…</translation>
    </message>
    <message>
        <source>Parallax: the view moves</source>
        <translation>Parallaxe: die Ansicht bewegt sich</translation>
    </message>
    <message>
        <source>Refocusing: the focus plane moves</source>
        <translation>Refokussieren: die Fokusebene bewegt sich</translation>
    </message>
    <message>
        <source>Through all views</source>
        <translation>Durch alle Ansichten</translation>
    </message>
    <message>
        <source>What changes</source>
        <translation>Was sich ändert</translation>
    </message>
    <message>
        <source>Path</source>
        <translation>Weg</translation>
    </message>
    <message>
        <source>Focus from</source>
        <translation>Fokus von</translation>
    </message>
    <message>
        <source>Focus to</source>
        <translation>Fokus bis</translation>
    </message>
    <message>
        <source> px</source>
        <translation> px</translation>
    </message>
    <message>
        <source>Disparity in focus at one end of the movement</source>
        <translation>Punkte dieser Disparität sind an einem Ende der Bewegung scharf</translation>
    </message>
    <message>
        <source>to</source>
        <translation>bis</translation>
    </message>
    <message>
        <source> s</source>
        <translation> s</translation>
    </message>
    <message>
        <source>as the views</source>
        <translation>wie die Ansichten</translation>
    </message>
    <message>
        <source>Duration</source>
        <translation>Dauer</translation>
    </message>
    <message>
        <source>Width</source>
        <translation>Breite</translation>
    </message>
    <message>
        <source>Around the center</source>
        <translation>Um die Mitte</translation>
    </message>
    <message>
        <source>Along the row of the center</source>
        <translation>Entlang der mittleren Zeile</translation>
    </message>
    <message>
        <source>Flip: A and B alternate</source>
        <translation>Umschalten: A und B im Wechsel</translation>
    </message>
</context>
<context>
    <name>episcope::NumberSpin</name>
    <message>
        <source>The minimum is %1</source>
        <translation>Das Minimum ist %1</translation>
    </message>
    <message>
        <source>The maximum is %1</source>
        <translation>Das Maximum ist %1</translation>
    </message>
</context>
<context>
    <name>episcope::OffscreenGl</name>
    <message>
        <source>There is no 3D view: this session has no display with OpenGL. Export the result as PLY to see it elsewhere.</source>
        <translation>Es gibt keine 3D-Ansicht: diese Sitzung hat keinen Bildschirm mit OpenGL. Das Ergebnis als PLY exportieren, um es anderswo zu sehen.</translation>
    </message>
</context>
<context>
    <name>episcope::Overlay</name>
    <message>
        <source>%1 − %2</source>
        <translation>%1 − %2</translation>
    </message>
    <message>
        <source>view</source>
        <translation>Ansicht</translation>
    </message>
    <message>
        <source>%1 (&gt; %2 px) of %3</source>
        <translation>%1 (&gt; %2 px) von %3</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 von %2</translation>
    </message>
    <message>
        <source> · the ground truth has no error</source>
        <translation> · die Referenz hat keinen Fehler</translation>
    </message>
    <message>
        <source>view (v %1, u %2)</source>
        <translation>Ansicht (v %1, u %2)</translation>
    </message>
    <message>
        <source> · %1</source>
        <translation> · %1</translation>
    </message>
    <message>
        <source> · no such map for this view</source>
        <translation> · keine solche Karte für diese Ansicht</translation>
    </message>
    <message>
        <source>≤ %1 px</source>
        <translation>≤ %1 px</translation>
    </message>
    <message>
        <source>wrong</source>
        <translation>falsch</translation>
    </message>
    <message>
        <source>&gt; %1 px</source>
        <translation>&gt; %1 px</translation>
    </message>
    <message>
        <source>ended early</source>
        <translation>vorzeitig beendet</translation>
    </message>
    <message>
        <source>defaults</source>
        <translation>Standardwerte</translation>
    </message>
    <message>
        <source>Belongs to another light field: %1. Its errors may be meaningless.</source>
        <translation>Gehört zu einem anderen Lichtfeld: %1. Seine Fehler besagen vielleicht nichts.</translation>
    </message>
</context>
<context>
    <name>episcope::OverlayBar</name>
    <message>
        <source>Opacity of the overlay</source>
        <translation>Deckkraft der Überlagerung</translation>
    </message>
    <message>
        <source>Focus plane: shears EPIs and view so that this disparity appears as zero (Alt+wheel, Ctrl+wheel, Shift+click)</source>
        <translation>Fokusebene: schert EPIs und Ansicht so, dass diese Disparität als null erscheint (Alt+Mausrad, Strg+Mausrad, Umschalt+Klick)</translation>
    </message>
    <message>
        <source>Focus plane</source>
        <translation>Fokus</translation>
    </message>
    <message>
        <source> px</source>
        <translation> px</translation>
    </message>
    <message>
        <source>Reset the focus plane to 0 px</source>
        <translation>Fokusebene auf 0 px zurücksetzen</translation>
    </message>
    <message>
        <source>Focus</source>
        <translation>Fokus</translation>
    </message>
    <message>
        <source>Map over the view</source>
        <translation>Karte über der Ansicht</translation>
    </message>
    <message>
        <source>Map over the view (M: next)</source>
        <translation>Karte über der Ansicht (M: nächste)</translation>
    </message>
    <message>
        <source>Map</source>
        <translation>Karte</translation>
    </message>
</context>
<context>
    <name>episcope::ParameterEditor</name>
    <message>
        <source>automatic</source>
        <translation>automatisch</translation>
    </message>
    <message>
        <source>auto</source>
        <translation>auto</translation>
    </message>
    <message>
        <source>Row of the view</source>
        <translation>Zeile der Ansicht</translation>
    </message>
    <message>
        <source>Column of the view</source>
        <translation>Spalte der Ansicht</translation>
    </message>
    <message>
        <source>Found: %1</source>
        <translation>Gefunden: %1</translation>
    </message>
    <message>
        <source>Found in the images</source>
        <translation>In den Bildern gefunden</translation>
    </message>
    <message>
        <source>Automatic</source>
        <translation>Automatisch</translation>
    </message>
    <message>
        <source>By hand</source>
        <translation>Von Hand</translation>
    </message>
    <message>
        <source>File: %1</source>
        <translation>Datei: %1</translation>
    </message>
</context>
<context>
    <name>episcope::ParameterForm</name>
    <message>
        <source>Reset to the default, %1</source>
        <translation>Auf den Standard zurücksetzen, %1</translation>
    </message>
    <message>
        <source>What this parameter does</source>
        <translation>Was dieser Parameter bewirkt</translation>
    </message>
    <message>
        <source>Help on %1</source>
        <translation>Hilfe zu %1</translation>
    </message>
    <message>
        <source>Advanced (%1)</source>
        <translation>Weitere (%1)</translation>
    </message>
    <message>
        <source>Advanced (%1, %2 changed)</source>
        <translation>Weitere (%1, davon %2 geändert)</translation>
    </message>
    <message>
        <source>Hides the parameters that are rarely changed</source>
        <translation>Verbirgt die Parameter, die selten geändert werden</translation>
    </message>
    <message>
        <source>Shows the parameters that are rarely changed</source>
        <translation>Zeigt die Parameter, die selten geändert werden</translation>
    </message>
</context>
<context>
    <name>episcope::ParameterHelp</name>
    <message>
        <source>Range %1</source>
        <translation>Bereich %1</translation>
    </message>
    <message>
        <source>Default %1</source>
        <translation>Standard %1</translation>
    </message>
    <message>
        <source>An EPI, a row for each view: points move along lines of these slopes.</source>
        <translation>Ein EPI, eine Zeile je Ansicht: Punkte wandern auf Linien dieser Steigungen.</translation>
    </message>
    <message>
        <source>The weight of each neighbor; a bar is a pixel, or a view.</source>
        <translation>Das Gewicht jedes Nachbarn; ein Balken ist ein Pixel oder eine Ansicht.</translation>
    </message>
    <message>
        <source>Disparity along a row of pixels: grey as measured, blue as smoothed.</source>
        <translation>Disparität entlang einer Pixelzeile: grau gemessen, blau geglättet.</translation>
    </message>
    <message>
        <source>How strongly neighbors are smoothed, from equal to unlike colors.</source>
        <translation>Wie stark Nachbarn geglättet werden, von gleichen zu ungleichen Farben.</translation>
    </message>
    <message>
        <source>The cost of a difference, 0 in the middle: blue grows no more at the cap.</source>
        <translation>Die Kosten eines Unterschieds, 0 in der Mitte: Blau wächst ab der Grenze nicht mehr.</translation>
    </message>
    <message>
        <source>The weight of an estimate, from no to full confidence.</source>
        <translation>Das Gewicht einer Schätzung, von keiner bis zu voller Konfidenz.</translation>
    </message>
    <message>
        <source>The disparities that are tested, over the whole range.</source>
        <translation>Die geprüften Disparitäten, über den ganzen Bereich.</translation>
    </message>
    <message>
        <source>What is left to improve; the iterations end at the dashed line.</source>
        <translation>Was noch zu verbessern ist; an der gestrichelten Linie enden die Iterationen.</translation>
    </message>
</context>
<context>
    <name>episcope::PartsLabel</name>
    <message>
        <source>+%1 more</source>
        <translation>+%1 weitere</translation>
    </message>
</context>
<context>
    <name>episcope::PatternPanel</name>
    <message>
        <source>no match</source>
        <translation>kein Treffer</translation>
    </message>
    <message>
        <source>%1 of %2 images match</source>
        <translation>%1 von %2 Bildern passen</translation>
    </message>
    <message>
        <source>a list of %1 views; the images tell its rows</source>
        <translation>eine Liste von %1 Ansichten, deren Zeilen sich aus den Bildern ergeben</translation>
    </message>
    <message>
        <source>%1×%2 views</source>
        <translation>%1×%2 Ansichten</translation>
    </message>
    <message>
        <source>no images here</source>
        <translation>keine Bilder hier</translation>
    </message>
    <message>
        <source>{row} and {col} stand for the numbers of a view, {index} for a running number, {x} and {y} for positions, * for anything. After re: follows a regular expression, as in re:view_(?&lt;row&gt;\d+)_(?&lt;col&gt;\d+)\.png.</source>
        <translation>{row} und {col} stehen für die Nummern einer Ansicht, {index} für eine laufende Nummer, {x} und {y} für Positionen, * für Beliebiges. Auf re: folgt ein regulärer Ausdruck, wie in re:view_(?&lt;row&gt;\d+)_(?&lt;col&gt;\d+)\.png.</translation>
    </message>
    <message>
        <source>File</source>
        <translation>Datei</translation>
    </message>
    <message>
        <source>Row</source>
        <translation>Zeile</translation>
    </message>
    <message>
        <source>Column</source>
        <translation>Spalte</translation>
    </message>
    <message>
        <source>Number</source>
        <translation>Nummer</translation>
    </message>
    <message>
        <source>View</source>
        <translation>Ansicht</translation>
    </message>
</context>
<context>
    <name>episcope::PhotographSteps</name>
    <message>
        <source>Lens</source>
        <translation>Objektiv</translation>
    </message>
    <message>
        <source>Rectify…</source>
        <translation>Rektifizieren…</translation>
    </message>
    <message>
        <source>Rectifies the open photographs into a light field with aligned rows and columns. Pairs picked in them are carried over.</source>
        <translation>Macht aus den geöffneten Fotos ein Lichtfeld: verzeichnungsfrei, mit ausgerichteten Zeilen und Spalten. Darin gewählte Punktpaare werden übernommen.</translation>
    </message>
    <message>
        <source>Calibrate from photographs…</source>
        <translation>Aus Fotos kalibrieren…</translation>
    </message>
    <message>
        <source>Open a camera…</source>
        <translation>Kamera öffnen…</translation>
    </message>
    <message>
        <source>Save the camera…</source>
        <translation>Kamera speichern…</translation>
    </message>
    <message>
        <source>Make a demo to try it with…</source>
        <translation>Demo zum Ausprobieren erzeugen…</translation>
    </message>
    <message>
        <source>No lens calibrated</source>
        <translation>Kein Objektiv kalibriert</translation>
    </message>
    <message>
        <source>Calibrates the camera from photographs of a flat pattern</source>
        <translation>Kalibriert die Kamera aus Fotos eines ebenen Musters</translation>
    </message>
</context>
<context>
    <name>episcope::Photographs</name>
    <message>
        <source>%1: %2 px</source>
        <translation>%1: %2 px</translation>
    </message>
    <message>
        <source>%1: left out, %2</source>
        <translation>%1: ausgelassen, %2</translation>
    </message>
    <message>
        <source>Rows aligned to %1 px (before %2 px)</source>
        <translation>Zeilen auf %1 px ausgerichtet (vorher %2 px)</translation>
    </message>
    <message>
        <source>Open a camera</source>
        <translation>Kamera öffnen</translation>
    </message>
    <message>
        <source>Camera (*.yml *.yaml)</source>
        <translation>Kamera (*.yml *.yaml)</translation>
    </message>
    <message>
        <source>Save the camera</source>
        <translation>Kamera speichern</translation>
    </message>
    <message>
        <source>Camera (*.yml)</source>
        <translation>Kamera (*.yml)</translation>
    </message>
    <message>
        <source>Folder in which to create the demo</source>
        <translation>Ordner, in dem die Demo angelegt wird</translation>
    </message>
    <message>
        <source>Photographs of the pattern</source>
        <translation>Fotos des Musters</translation>
    </message>
    <message>
        <source>Images (*.png *.jpg *.jpeg *.tif *.tiff *.bmp);;All files (*)</source>
        <translation>Bilder (*.png *.jpg *.jpeg *.tif *.tiff *.bmp);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>The pattern that was photographed</source>
        <translation>Das fotografierte Muster</translation>
    </message>
    <message>
        <source>Photographs…</source>
        <translation>Fotos…</translation>
    </message>
    <message>
        <source>Save the rectified light field</source>
        <translation>Rektifiziertes Lichtfeld speichern</translation>
    </message>
    <message>
        <source>Light field (*.h5)</source>
        <translation>Lichtfeld (*.h5)</translation>
    </message>
    <message>
        <source>Rectify the photographs</source>
        <translation>Fotos rektifizieren</translation>
    </message>
    <message>
        <source>Save as…</source>
        <translation>Speichern unter…</translation>
    </message>
    <message>
        <source>Calibrating the lens</source>
        <translation>Kalibrieren des Objektivs</translation>
    </message>
    <message>
        <source>%1 of %2 photographs used</source>
        <translation>%1 von %2 Fotos verwendet</translation>
    </message>
    <message>
        <source>%1 of %2 photographs of the pattern were left out; the tool tip of “Lens” tells why.</source>
        <translation>%1 von %2 Fotos des Musters wurden ausgelassen; warum, sagt der Tooltip von „Objektiv“.</translation>
    </message>
    <message>
        <source>Rectifying</source>
        <translation>Rektifizieren</translation>
    </message>
    <message>
        <source>Making the demo</source>
        <translation>Erzeugen der Demo</translation>
    </message>
    <message>
        <source>These are photographs of a gantry, with points picked. Rectify them to find the pose of the mesh.</source>
        <translation>Dies sind Fotos eines Kameraportals, mit gewählten Punkten. Erst das Rektifizieren erlaubt es, die Pose des Netzes zu bestimmen.</translation>
    </message>
    <message>
        <source>Lens: focal length %1 px, error %2 px</source>
        <translation>Objektiv: Brennweite %1 px, Fehler %2 px</translation>
    </message>
    <message>
        <source>Open the folder of photographs.</source>
        <translation>Den Ordner mit den Fotos öffnen.</translation>
    </message>
    <message>
        <source>The light field tells its lens; it is rectified.</source>
        <translation>Das Lichtfeld nennt sein Objektiv; es ist rektifiziert.</translation>
    </message>
    <message>
        <source>Photographs of a gantry are rectified next.</source>
        <translation>Als Nächstes werden die Fotos des Kameraportals rektifiziert.</translation>
    </message>
    <message>
        <source>Photographs of a gantry need the lens first.</source>
        <translation>Fotos brauchen zuerst das kalibrierte Objektiv.</translation>
    </message>
    <message>
        <source>The lens was dropped: its light field was closed meanwhile.</source>
        <translation>Das Objektiv wurde verworfen: Das Lichtfeld dazu wurde inzwischen geschlossen.</translation>
    </message>
</context>
<context>
    <name>episcope::PictureExport</name>
    <message>
        <source>Save the picture</source>
        <translation>Bild speichern</translation>
    </message>
    <message>
        <source>PNG (*.png)</source>
        <translation>PNG (*.png)</translation>
    </message>
    <message>
        <source>No map is shown: choose one in the tool bar, then save it.</source>
        <translation>Es wird keine Karte gezeigt: erst eine in der Werkzeugleiste wählen, dann speichern.</translation>
    </message>
    <message>
        <source>Save the map</source>
        <translation>Karte speichern</translation>
    </message>
    <message>
        <source>Saves the view as it is shown, with its brightness and overlay, as PNG</source>
        <translation>Speichert die Ansicht wie gezeigt, mit Helligkeit und Überlagerung, als PNG</translation>
    </message>
    <message>
        <source>Ctrl+Shift+E</source>
        <translation>Ctrl+Shift+E</translation>
    </message>
    <message>
        <source>Saves the map drawn over the view as PNG</source>
        <translation>Speichert die über die Ansicht gelegte Karte als PNG</translation>
    </message>
    <message>
        <source>Picture…</source>
        <translation>Bild…</translation>
    </message>
    <message>
        <source>Map…</source>
        <translation>Karte…</translation>
    </message>
</context>
<context>
    <name>episcope::PointCloudPanel</name>
    <message>
        <source>Front</source>
        <translation>Vorn</translation>
    </message>
    <message>
        <source>Tilted</source>
        <translation>Schräg</translation>
    </message>
    <message>
        <source>Side</source>
        <translation>Seite</translation>
    </message>
</context>
<context>
    <name>episcope::PointCloudView</name>
    <message>
        <source>3D view</source>
        <translation>3D-Ansicht</translation>
    </message>
</context>
<context>
    <name>episcope::ProjectController</name>
    <message>
        <source>Save</source>
        <translation>Speichern</translation>
    </message>
    <message>
        <source>Saves all open light fields with their results and scribbles as a project</source>
        <translation>Speichert alle geöffneten Lichtfelder mit ihren Ergebnissen und Strichen als Projekt</translation>
    </message>
    <message>
        <source>Ctrl+Alt+S</source>
        <translation>Ctrl+Alt+S</translation>
    </message>
    <message>
        <source>Opening %1</source>
        <translation>Öffnen von %1</translation>
    </message>
    <message>
        <source>Save project</source>
        <translation>Projekt speichern</translation>
    </message>
    <message>
        <source>Projects (*.episcope)</source>
        <translation>Projekte (*.episcope)</translation>
    </message>
    <message>
        <source>Saving %1</source>
        <translation>Speichern von %1</translation>
    </message>
    <message>
        <source>Light field not found</source>
        <translation>Lichtfeld nicht gefunden</translation>
    </message>
    <message>
        <source>“%1” is no longer at %2. Where is it now? Files that were moved with it are then found too.</source>
        <translation>„%1“ ist nicht mehr unter %2. Wo ist es jetzt? Andere, die mit verschoben wurden, werden dann auch gefunden.</translation>
    </message>
    <message>
        <source>Choose file…</source>
        <translation>Datei wählen…</translation>
    </message>
    <message>
        <source>Choose folder…</source>
        <translation>Ordner wählen…</translation>
    </message>
    <message>
        <source>Reloading replaces the open light fields.</source>
        <translation>Neuladen ersetzt, was hier geöffnet ist.</translation>
    </message>
    <message>
        <source>Save as…</source>
        <translation>Speichern unter…</translation>
    </message>
    <message>
        <source>Saves the project; without one, new scribbles, or asks where</source>
        <translation>Speichert das Projekt; ohne Projekt neue Striche, oder fragt, wohin</translation>
    </message>
</context>
<context>
    <name>episcope::ProjectGuard</name>
    <message>
        <source>Not saved: %1.</source>
        <translation>Nicht gespeichert: %1.</translation>
    </message>
    <message>
        <source>Unsaved scribbles: on %1.</source>
        <translation>Nicht gespeicherte Striche: in %1.</translation>
    </message>
    <message>
        <source>The project has changed.</source>
        <translation>Das Projekt wurde geändert.</translation>
    </message>
    <message>
        <source>Unsaved work</source>
        <translation>Nicht gespeicherte Arbeit</translation>
    </message>
    <message>
        <source>sweep of %1</source>
        <translation>Versuchsreihe mit %1</translation>
    </message>
    <message>
        <source>Unsaved pairs of points: on %1.</source>
        <translation>Nicht gespeicherte Punktpaare: auf %1.</translation>
    </message>
    <message>
        <source>Unsaved measured lines: on %1.</source>
        <translation>Nicht gespeicherte behaltene Linien: auf %1.</translation>
    </message>
    <message>
        <source>%1 (%2 %)</source>
        <translation>%1 (%2 %)</translation>
    </message>
    <message>
        <source>Still running, and would be lost: %1.</source>
        <translation>Läuft noch und ginge verloren: %1.</translation>
    </message>
    <message>
        <source>labels of all views</source>
        <translation>Labels aller Ansichten</translation>
    </message>
    <message>
        <source>Work is running</source>
        <translation>Es wird noch gerechnet</translation>
    </message>
    <message>
        <source>labels of one view</source>
        <translation>Labels einer Ansicht</translation>
    </message>
    <message>
        <source>Quit anyway</source>
        <translation>Trotzdem beenden</translation>
    </message>
    <message>
        <source>Close anyway</source>
        <translation>Trotzdem schließen</translation>
    </message>
</context>
<context>
    <name>episcope::QuestionBox</name>
    <message>
        <source>%1 and %2 more</source>
        <translation>%1 und %2 weitere</translation>
    </message>
    <message>
        <source>Replace files</source>
        <translation>Dateien ersetzen</translation>
    </message>
    <message>
        <source>The folder already holds %1. Replace it?</source>
        <translation>Der Ordner enthält schon %1. Ersetzen?</translation>
    </message>
    <message>
        <source>Discard earlier work</source>
        <translation>Frühere Arbeit verwerfen</translation>
    </message>
</context>
<context>
    <name>episcope::RawPicturePanel</name>
    <message>
        <source>Raw picture</source>
        <translation>Rohbild</translation>
    </message>
    <message>
        <source>White picture</source>
        <translation>Weißbild</translation>
    </message>
    <message>
        <source>Find lenses</source>
        <translation>Linsen finden</translation>
    </message>
    <message>
        <source>Decode…</source>
        <translation>Dekodieren…</translation>
    </message>
    <message>
        <source>Lens centers</source>
        <translation>Linsenmitten</translation>
    </message>
    <message>
        <source>Shown picture</source>
        <translation>Gezeigtes Bild</translation>
    </message>
    <message>
        <source>Marks the center of each lens; enlarge the picture with the wheel</source>
        <translation>Markiert die Mitte jeder Linse; das Mausrad vergrößert das Bild</translation>
    </message>
    <message>
        <source>Open a raw picture of a plenoptic camera: .lfp, .lfr, .raw, or the picture of a sensor behind microlenses.</source>
        <translation>Ein Rohbild einer plenoptischen Kamera öffnen: .lfp, .lfr, .raw oder das Bild eines Sensors hinter Mikrolinsen.</translation>
    </message>
    <message>
        <source>What the sensor of a plenoptic camera saw</source>
        <translation>Was der Sensor einer plenoptischen Kamera sah</translation>
    </message>
    <message>
        <source>An evenly lit white area: it shows the lenses and their shading</source>
        <translation>Eine gleichmäßig beleuchtete weiße Fläche: Sie zeigt die Linsen und ihre Abschattung</translation>
    </message>
    <message>
        <source>Fits the grid of the lenses again</source>
        <translation>Passt das Raster der Linsen neu an</translation>
    </message>
    <message>
        <source>Writes the views as a light field and opens it</source>
        <translation>Schreibt die Ansichten als Lichtfeld und öffnet es</translation>
    </message>
    <message>
        <source>Open a raw picture…</source>
        <translation>Rohbild öffnen…</translation>
    </message>
    <message>
        <source>Colors of the first pixels</source>
        <translation>Farben der ersten Pixel</translation>
    </message>
    <message>
        <source>Optics of the camera…</source>
        <translation>Optik der Kamera…</translation>
    </message>
    <message>
        <source>A computed one to try</source>
        <translation>Ein berechnetes zum Ausprobieren</translation>
    </message>
    <message>
        <source>White picture or archive of calibration data…</source>
        <translation>Weißbild oder Archiv mit Kalibrierdaten…</translation>
    </message>
    <message>
        <source>Folder of calibration data…</source>
        <translation>Ordner mit Kalibrierdaten…</translation>
    </message>
    <message>
        <source>Dark picture…</source>
        <translation>Dunkelbild…</translation>
    </message>
    <message>
        <source>No raw picture</source>
        <translation>Kein Rohbild</translation>
    </message>
    <message>
        <source>No white picture</source>
        <translation>Kein Weißbild</translation>
    </message>
    <message>
        <source>Lenses are not found yet</source>
        <translation>Linsen noch nicht gefunden</translation>
    </message>
    <message>
        <source>No views yet</source>
        <translation>Noch keine Ansichten</translation>
    </message>
    <message>
        <source>Gray</source>
        <translation>Grau</translation>
    </message>
    <message>
        <source>Bayer %1</source>
        <translation>Bayer %1</translation>
    </message>
</context>
<context>
    <name>episcope::RawPictures</name>
    <message>
        <source>Raw picture</source>
        <translation>Rohbild</translation>
    </message>
    <message>
        <source>White picture</source>
        <translation>Weißbild</translation>
    </message>
    <message>
        <source>Dark picture</source>
        <translation>Dunkelbild</translation>
    </message>
    <message>
        <source>hexagonal</source>
        <translation>hexagonal</translation>
    </message>
    <message>
        <source>square</source>
        <translation>quadratisch</translation>
    </message>
    <message>
        <source>Lenses: %1, %2 px, turned by %3°; %4 fit to %5 px, %6 do not</source>
        <translation>Linsen: %1, %2 px, um %3° gedreht; %4 passen auf %5 px, %6 nicht</translation>
    </message>
    <message>
        <source>%1×%2 views of %3×%4 px</source>
        <translation>%1×%2 Ansichten von %3×%4 px</translation>
    </message>
    <message>
        <source>Open a raw picture</source>
        <translation>Rohbild öffnen</translation>
    </message>
    <message>
        <source>Raw pictures (*.lfp *.lfr *.raw *.RAW *.png *.tif *.tiff *.pgm *.bmp);;All files (*)</source>
        <translation>Rohbilder (*.lfp *.lfr *.raw *.RAW *.png *.tif *.tiff *.pgm *.bmp);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Open a white picture</source>
        <translation>Weißbild öffnen</translation>
    </message>
    <message>
        <source>Open a dark picture</source>
        <translation>Dunkelbild öffnen</translation>
    </message>
    <message>
        <source>Open the optics of a camera</source>
        <translation>Optik einer Kamera öffnen</translation>
    </message>
    <message>
        <source>Folder of calibration data</source>
        <translation>Ordner mit Kalibrierdaten</translation>
    </message>
    <message>
        <source>All files (*)</source>
        <translation>Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Reading %1</source>
        <translation>Lesen von %1</translation>
    </message>
    <message>
        <source>Finding the lenses</source>
        <translation>Suchen der Linsen</translation>
    </message>
    <message>
        <source>Save the views</source>
        <translation>Ansichten speichern</translation>
    </message>
    <message>
        <source>Light field (*.h5)</source>
        <translation>Lichtfeld (*.h5)</translation>
    </message>
    <message>
        <source>Decode the raw picture</source>
        <translation>Rohbild dekodieren</translation>
    </message>
    <message>
        <source>Save as…</source>
        <translation>Speichern unter…</translation>
    </message>
    <message>
        <source>Decoding</source>
        <translation>Dekodieren</translation>
    </message>
    <message>
        <source>%1, %2 % valid, %3 hot pixels replaced</source>
        <translation>%1, %2 % gültig, %3 heiße Pixel ersetzt</translation>
    </message>
    <message>
        <source>%1: %2×%3 px, %4</source>
        <translation>%1: %2×%3 px, %4</translation>
    </message>
</context>
<context>
    <name>episcope::ReadingQuestion</name>
    <message>
        <source>How is it to be read?</source>
        <translation>Wie ist das zu lesen?</translation>
    </message>
    <message>
        <source>Your choice is remembered for this file; “Conventions…” changes it.</source>
        <translation>Die Wahl wird für diese Datei gemerkt; „Konventionen…“ ändert sie.</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Öffnen</translation>
    </message>
</context>
<context>
    <name>episcope::RecoveryController</name>
    <message>
        <source>Recover</source>
        <translation>Wiederherstellen</translation>
    </message>
    <message>
        <source>“%1” is no longer the light field that was annotated. Your work is kept in %2.</source>
        <translation>„%1“ ist nicht mehr das Lichtfeld, das annotiert wurde. Die Arbeit wird in %2 aufbewahrt.</translation>
    </message>
    <message>
        <source>Recovered the annotation of “%1”.</source>
        <translation>Annotation von „%1“ wiederhergestellt.</translation>
    </message>
    <message>
        <source>Discard…</source>
        <translation>Verwerfen…</translation>
    </message>
    <message>
        <source>This deletes the scribbles on “%1” that were not saved.</source>
        <translation>Das löscht die Striche auf „%1“, die nicht gespeichert wurden.</translation>
    </message>
    <message>
        <source>Episcope ended unexpectedly while “%1” was being annotated (%2). Strokes to recover: %3.</source>
        <translation>Episcope endete unerwartet, während „%1“ annotiert wurde (%2). Wiederherstellbare Striche: %3.</translation>
    </message>
</context>
<context>
    <name>episcope::RegionBar</name>
    <message>
        <source>Pixels that the table and the plot evaluate</source>
        <translation>Die Pixel, auf die sich Tabelle und Diagramm beziehen</translation>
    </message>
    <message>
        <source>Part of the view to evaluate on</source>
        <translation>Bewerteter Teil der Ansicht</translation>
    </message>
    <message>
        <source>Evaluate on:</source>
        <translation>Bewertet:</translation>
    </message>
</context>
<context>
    <name>episcope::RegionController</name>
    <message>
        <source>Rectangle</source>
        <translation>Rechteck</translation>
    </message>
    <message>
        <source>Current label</source>
        <translation>Aktuelles Label</translation>
    </message>
    <message>
        <source>Where all results have values</source>
        <translation>Wo alle Ergebnisse Werte haben</translation>
    </message>
    <message>
        <source>The next drag on the view draws a rectangle in which metrics are computed</source>
        <translation>Das nächste Ziehen in der Ansicht zeichnet das Rechteck, auf das sich die Fehlermaße beziehen</translation>
    </message>
    <message>
        <source>Ctrl+Alt+R</source>
        <translation>Ctrl+Alt+R</translation>
    </message>
    <message>
        <source>Computes metrics over the whole view again</source>
        <translation>Die Fehlermaße beziehen sich wieder auf die ganze Ansicht</translation>
    </message>
    <message>
        <source>Ctrl+Alt+W</source>
        <translation>Ctrl+Alt+W</translation>
    </message>
    <message>
        <source>Drag a rectangle on the view. Esc leaves it.</source>
        <translation>Ein Rechteck in der Ansicht aufziehen. Esc bricht ab.</translation>
    </message>
    <message>
        <source>Mask of the evaluated pixels: all that are not black</source>
        <translation>Maske der bewerteten Pixel: alle, die nicht schwarz sind</translation>
    </message>
    <message>
        <source>Images (*.png *.tif *.tiff *.pgm *.bmp)</source>
        <translation>Bilder (*.png *.tif *.tiff *.pgm *.bmp)</translation>
    </message>
    <message>
        <source>Mask %1</source>
        <translation>Maske %1</translation>
    </message>
    <message>
        <source>The mask has %1×%2 px, but the views have %3×%4 px: choose a mask of the size of the views.</source>
        <translation>Die Maske hat %1×%2 px, die Ansichten aber %3×%4 px: eine Maske von der Größe der Ansichten wählen.</translation>
    </message>
    <message>
        <source>%1 px</source>
        <translation>%1 px</translation>
    </message>
    <message>
        <source>rectangle x %1–%2, y %3–%4</source>
        <translation>Rechteck x %1–%2, y %3–%4</translation>
    </message>
    <message>
        <source>label %1</source>
        <translation>Label %1</translation>
    </message>
    <message>
        <source>where all results have values</source>
        <translation>wo alle Ergebnisse Werte haben</translation>
    </message>
    <message>
        <source>mask %1</source>
        <translation>Maske %1</translation>
    </message>
    <message>
        <source>whole view</source>
        <translation>ganze Ansicht</translation>
    </message>
    <message>
        <source>Evaluate a rectangle</source>
        <translation>Ein Rechteck bewerten</translation>
    </message>
    <message>
        <source>Evaluate the whole view</source>
        <translation>Die ganze Ansicht bewerten</translation>
    </message>
    <message>
        <source>Mask from a file…</source>
        <translation>Maske aus einer Datei…</translation>
    </message>
    <message>
        <source>Region: %1</source>
        <translation>Region: %1</translation>
    </message>
    <message>
        <source>region %1</source>
        <translation>Region %1</translation>
    </message>
    <message>
        <source>Whole center view</source>
        <translation>Ganze mittlere Ansicht</translation>
    </message>
</context>
<context>
    <name>episcope::ResultExport</name>
    <message>
        <source>Export %1</source>
        <translation>%1 exportieren</translation>
    </message>
    <message>
        <source>Result, all views (*.h5);;Map of this view (*.pfm);;Map of this view (*.tiff);;Point cloud of this view (*.ply)</source>
        <translation>Ergebnis, alle Ansichten (*.h5);;Karte dieser Ansicht (*.pfm);;Karte dieser Ansicht (*.tiff);;Punktwolke dieser Ansicht (*.ply)</translation>
    </message>
    <message>
        <source>Folder of the submission for %1</source>
        <translation>Ordner der Einreichung, in die %1 kommt</translation>
    </message>
    <message>
        <source>Reloading adds the results in the file to the list.</source>
        <translation>Neuladen fügt der Liste der Ergebnisse hinzu, was in der Datei steht.</translation>
    </message>
    <message>
        <source>%1 has no map of this view: go to the center view (Home) first.</source>
        <translation>%1 hat keine Karte dieser Ansicht: erst zur mittleren Ansicht gehen (Pos1).</translation>
    </message>
    <message>
        <source>%1 has no map of the center view, which is submitted.</source>
        <translation>%1 hat keine Karte der mittleren Ansicht, die eingereicht wird.</translation>
    </message>
</context>
<context>
    <name>episcope::ResultList</name>
    <message>
        <source>Save this result as HDF5, PFM, TIFF or PLY</source>
        <translation>Dieses Ergebnis als HDF5, PFM, TIFF oder PLY speichern</translation>
    </message>
    <message>
        <source>Export</source>
        <translation>Exportieren</translation>
    </message>
    <message>
        <source>Remove this result</source>
        <translation>Dieses Ergebnis entfernen</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Copy the parameters of this result to the form</source>
        <translation>Parameter dieses Ergebnisses in das Formular übernehmen</translation>
    </message>
    <message>
        <source>Reuse</source>
        <translation>Übernehmen</translation>
    </message>
    <message>
        <source>Results</source>
        <translation>Ergebnisse</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>Verfahren</translation>
    </message>
    <message>
        <source>MSE×100</source>
        <translation>MSE×100</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>Parameters</source>
        <translation>Parameter</translation>
    </message>
    <message>
        <source>Mean squared error ×100 against the ground truth, px²</source>
        <translation>Mittlerer quadratischer Fehler ×100 gegenüber der Referenz, px²</translation>
    </message>
    <message>
        <source>The result appears here.</source>
        <translation>Das Ergebnis erscheint hier.</translation>
    </message>
    <message>
        <source>No results yet. Run a method above.</source>
        <translation>Noch keine Ergebnisse. Oben ein Verfahren starten.</translation>
    </message>
    <message>
        <source>A: this result is shown</source>
        <translation>A: dieses Ergebnis wird angezeigt</translation>
    </message>
    <message>
        <source>Click here to compare with this result (B)</source>
        <translation>Hier klicken, um mit diesem Ergebnis (B) zu vergleichen</translation>
    </message>
    <message>
        <source>Show</source>
        <translation>Anzeigen</translation>
    </message>
    <message>
        <source>Compare with</source>
        <translation>Vergleichen mit</translation>
    </message>
    <message>
        <source>Reuse parameters</source>
        <translation>Parameter übernehmen</translation>
    </message>
    <message>
        <source>Copy as command</source>
        <translation>Als Befehl kopieren</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>Umbenennen</translation>
    </message>
    <message>
        <source>Note…</source>
        <translation>Notiz…</translation>
    </message>
    <message>
        <source>Export…</source>
        <translation>Exportieren…</translation>
    </message>
    <message>
        <source>new</source>
        <translation>neu</translation>
    </message>
    <message>
        <source>“%1”</source>
        <translation>„%1“</translation>
    </message>
    <message>
        <source> · </source>
        <translation> · </translation>
    </message>
</context>
<context>
    <name>episcope::ResultOpener</name>
    <message>
        <source>Opening %1</source>
        <translation>Öffnen von %1</translation>
    </message>
    <message>
        <source>%1 was estimated with%2: its errors may be meaningless. Choose the same values in Conventions…</source>
        <translation>%1 wurde mit%2 geschätzt: seine Fehler sind womöglich bedeutungslos. Dasselbe wählen unter Konventionen…</translation>
    </message>
    <message>
        <source>%1 was estimated from different samples than those of this light field: its errors may be meaningless.</source>
        <translation>%1 wurde aus anderen Samples als denen dieses Lichtfelds geschätzt: seine Fehler sind womöglich bedeutungslos.</translation>
    </message>
    <message>
        <source>%1: %2. If the file is stored so, apply it.</source>
        <translation>%1: %2. Wenn die Datei so gespeichert ist, wenden Sie es an.</translation>
    </message>
    <message>
        <source>Apply</source>
        <translation>Anwenden</translation>
    </message>
    <message>
        <source>%1 is the ground truth of this light field.</source>
        <translation>%1 ist die Referenz dieses Lichtfelds.</translation>
    </message>
    <message>
        <source>%1 can be added to the results.</source>
        <translation>%1 kann zu den Ergebnissen hinzugefügt werden.</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Hinzufügen</translation>
    </message>
</context>
<context>
    <name>episcope::SaveForms</name>
    <message>
        <source>Archive file (HDF5)</source>
        <translation>Archivdatei (HDF5)</translation>
    </message>
    <message>
        <source>Folder of the 2016 benchmark</source>
        <translation>Ordner des Benchmarks von 2016</translation>
    </message>
    <message>
        <source>Folder of images</source>
        <translation>Ordner mit Bildern</translation>
    </message>
    <message>
        <source>NumPy array</source>
        <translation>NumPy-Array</translation>
    </message>
    <message>
        <source>NumPy arrays with ground truth and labels</source>
        <translation>NumPy-Arrays mit Referenz und Labels</translation>
    </message>
    <message>
        <source>MATLAB file of the Light Field Toolbox</source>
        <translation>MATLAB-Datei der Light Field Toolbox</translation>
    </message>
    <message>
        <source>Picture of lenslets (ESLF)</source>
        <translation>Bild aus Linsenbildern (ESLF)</translation>
    </message>
    <message>
        <source>%1…</source>
        <translation>%1…</translation>
    </message>
    <message>
        <source>Save %1: %2</source>
        <translation>%1 speichern: %2</translation>
    </message>
    <message>
        <source>New folders (*)</source>
        <translation>Neue Ordner (*)</translation>
    </message>
    <message>
        <source>%1 was not written: its name must end in %2.</source>
        <translation>%1 wurde nicht geschrieben: der Name muss auf %2 enden.</translation>
    </message>
    <message>
        <source>%1 was not written: it belongs to the light field that is open; choose another name.</source>
        <translation>%1 wurde nicht geschrieben: es gehört zum geöffneten Lichtfeld; einen anderen Namen wählen.</translation>
    </message>
    <message>
        <source>Writing %1</source>
        <translation>Schreiben von %1</translation>
    </message>
    <message>
        <source>Saved: %1.</source>
        <translation>Geschrieben: %1.</translation>
    </message>
    <message>
        <source>Quilt for light-field displays</source>
        <translation>Quilt für Lichtfeld-Displays</translation>
    </message>
</context>
<context>
    <name>episcope::SceneChooser</name>
    <message>
        <source>%1 · 1 result</source>
        <translation>%1 · 1 Ergebnis</translation>
    </message>
    <message>
        <source>%1 · %2 results</source>
        <translation>%1 · %2 Ergebnisse</translation>
    </message>
    <message>
        <source>Open light fields</source>
        <translation>Geöffnete Lichtfelder</translation>
    </message>
    <message>
        <source>Open light fields: choose the one to show</source>
        <translation>Die geöffneten Lichtfelder: das anzuzeigende wählen</translation>
    </message>
    <message>
        <source>nothing is open</source>
        <translation>nichts geöffnet</translation>
    </message>
    <message>
        <source>Next open light field</source>
        <translation>Nächstes geöffnetes Lichtfeld</translation>
    </message>
    <message>
        <source>Shows the next open light field</source>
        <translation>Zeigt das nächste der geöffneten Lichtfelder</translation>
    </message>
    <message>
        <source>Ctrl+Alt+PgDown</source>
        <translation>Ctrl+Alt+PgDown</translation>
    </message>
    <message>
        <source>Previous open light field</source>
        <translation>Voriges geöffnetes Lichtfeld</translation>
    </message>
    <message>
        <source>Shows the previous open light field</source>
        <translation>Zeigt das vorige der geöffneten Lichtfelder</translation>
    </message>
    <message>
        <source>Ctrl+Alt+PgUp</source>
        <translation>Ctrl+Alt+PgUp</translation>
    </message>
    <message>
        <source>none of these is shown</source>
        <translation>keines davon wird gezeigt</translation>
    </message>
    <message>
        <source>opening …</source>
        <translation>wird geöffnet …</translation>
    </message>
    <message>
        <source>Open light field: %1</source>
        <translation>Geöffnetes Lichtfeld: %1</translation>
    </message>
    <message>
        <source>Shows it: %1</source>
        <translation>Zeigt es: %1</translation>
    </message>
</context>
<context>
    <name>episcope::SceneList</name>
    <message>
        <source>ground truth</source>
        <translation>Referenz</translation>
    </message>
</context>
<context>
    <name>episcope::SceneOpener</name>
    <message>
        <source>%1 · reading all views …</source>
        <translation>%1 · alle Ansichten werden gelesen …</translation>
    </message>
    <message>
        <source>Opening %1</source>
        <translation>Öffnen von %1</translation>
    </message>
    <message>
        <source>%1: %2. “Conventions…” lets you choose.</source>
        <translation>%1: %2. Unter „Konventionen…“ lässt es sich festlegen.</translation>
    </message>
    <message>
        <source>Caching the built-in scene</source>
        <translation>Zwischenspeichern der eingebauten Szene</translation>
    </message>
    <message>
        <source>The raw picture of a plenoptic camera is opened in the tab Capture, on the page “Raw picture”.</source>
        <translation>Das Rohbild einer plenoptischen Kamera wird im Reiter Aufnahme geöffnet, auf der Seite „Rohbild“.</translation>
    </message>
</context>
<context>
    <name>episcope::ScenePanel</name>
    <message>
        <source>Scenes</source>
        <translation>Szenen</translation>
    </message>
    <message>
        <source>Filter</source>
        <translation>Filter</translation>
    </message>
    <message>
        <source>Order</source>
        <translation>Sortierung</translation>
    </message>
    <message>
        <source>Filter: name, form, ground truth …</source>
        <translation>Filter: Name, Form, Referenz …</translation>
    </message>
    <message>
        <source>Order of the list</source>
        <translation>Sortierung der Liste</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Form</source>
        <translation>Form</translation>
    </message>
    <message>
        <source>Size</source>
        <translation>Größe</translation>
    </message>
    <message>
        <source>Ground truth</source>
        <translation>Referenz</translation>
    </message>
    <message>
        <source>%1 of %2 light fields</source>
        <translation>%1 von %2 Lichtfeldern</translation>
    </message>
    <message>
        <source>1 light field</source>
        <translation>1 Lichtfeld</translation>
    </message>
    <message>
        <source>%1 light fields</source>
        <translation>%1 Lichtfelder</translation>
    </message>
    <message>
        <source>, %1 cannot be opened</source>
        <translation>, %1 nicht zu öffnen</translation>
    </message>
    <message>
        <source>Searching … %1</source>
        <translation>Suche … %1</translation>
    </message>
    <message>
        <source>No light field matches the filter.</source>
        <translation>Kein Lichtfeld passt zum Filter.</translation>
    </message>
    <message>
        <source>Open a folder of light fields, or drop it here. Its subfolders are listed too.</source>
        <translation>Einen Ordner mit Lichtfeldern öffnen oder hier ablegen: alles darin wird aufgelistet, in beliebiger Tiefe.</translation>
    </message>
    <message>
        <source>Searching …</source>
        <translation>Suche …</translation>
    </message>
    <message>
        <source>There is no light field in here.</source>
        <translation>Hier ist kein Lichtfeld.</translation>
    </message>
</context>
<context>
    <name>episcope::SceneSwitcher</name>
    <message>
        <source>“%1” has other samples than before: results and scribbles may not fit.</source>
        <translation>„%1“ hat andere Samples als zuvor: Ergebnisse und Striche passen womöglich nicht.</translation>
    </message>
    <message>
        <source>Opening %1</source>
        <translation>Öffnen von %1</translation>
    </message>
    <message>
        <source>%1 is not “%2”: it has other samples. Nothing was changed.</source>
        <translation>%1 ist nicht „%2“: Die Datei hat andere Samples. Nichts wurde geändert.</translation>
    </message>
</context>
<context>
    <name>episcope::Schema</name>
    <message>
        <source>label %1</source>
        <translation>Label %1</translation>
    </message>
    <message>
        <source>Seed</source>
        <translation>Startwert</translation>
    </message>
    <message>
        <source>Each number is another scene</source>
        <translation>Jede Zahl ist eine andere Szene</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>Art</translation>
    </message>
    <message>
        <source>What the scene is made of; any is a mixture</source>
        <translation>Woraus die Szene besteht; any ist eine Mischung</translation>
    </message>
    <message>
        <source>on</source>
        <translation>ein</translation>
    </message>
    <message>
        <source>off</source>
        <translation>aus</translation>
    </message>
    <message>
        <source>found</source>
        <translation>ermittelt</translation>
    </message>
    <message>
        <source>auto</source>
        <translation>auto</translation>
    </message>
    <message>
        <source>(1/255)²</source>
        <translation>(1/255)²</translation>
    </message>
    <message>
        <source>1/255</source>
        <translation>1/255</translation>
    </message>
    <message>
        <source>3 to 40 objects drawn from a seed: random?seed=7&amp;kind=thin</source>
        <translation>3 bis 40 Objekte aus einem Startwert: random?seed=7&amp;kind=thin</translation>
    </message>
    <message>
        <source>A pair of neighbors is weighted by exp(−β·|difference of their colors|)</source>
        <translation>Ein Paar von Nachbarn wird mit exp(−β·|Unterschied ihrer Farben|) gewichtet</translation>
    </message>
    <message>
        <source>A surface nearer than a point by more than this occludes it</source>
        <translation>Eine Fläche, die um mehr als diesen Wert näher ist als ein Punkt, verdeckt ihn</translation>
    </message>
    <message>
        <source>A surface whose confidence is below this, mean over its surroundings, occludes nothing</source>
        <translation>Eine Fläche, deren Konfidenz im Mittel über ihre Umgebung darunter liegt, verdeckt nichts</translation>
    </message>
    <message>
        <source>Add to the costs what interpolation averages away of the noise, so that labels that move views by whole pixels are at no disadvantage</source>
        <translation>Addiert zu den Kosten, was die Interpolation vom Rauschen wegmittelt, damit Labels, die Ansichten um ganze Pixel verschieben, nicht im Nachteil sind</translation>
    </message>
    <message>
        <source>Axes</source>
        <translation>Achsen</translation>
    </message>
    <message>
        <source>Axes of an array in the order of its indices: v and u for rows and columns of views, y, x, c for channels, as in vuyxc; empty = detected</source>
        <translation>Achsen eines Arrays in der Reihenfolge seiner Indizes: v und u für Zeilen und Spalten von Ansichten, y, x, c für Kanäle, wie in vuyxc; leer = ermittelt</translation>
    </message>
    <message>
        <source>Before the first sweep, replace the disparity of rays that other views see through</source>
        <translation>Ersetzt vor dem ersten Durchgang die Disparität von Strahlen, durch die andere Ansichten hindurchsehen</translation>
    </message>
    <message>
        <source>Between neighboring positions of the gantry, in the unit of the mesh; with 1, depth is in steps</source>
        <translation>Abstand benachbarter Positionen des Kameraportals, in der Einheit des Netzes; mit 1 ist die Tiefe in Schritten</translation>
    </message>
    <message>
        <source>Check lines</source>
        <translation>Linien prüfen</translation>
    </message>
    <message>
        <source>Choose sides</source>
        <translation>Seiten wählen</translation>
    </message>
    <message>
        <source>Coherence exponent p</source>
        <translation>Exponent p der Kohärenz</translation>
    </message>
    <message>
        <source>Columns</source>
        <translation>Spalten</translation>
    </message>
    <message>
        <source>Comparison</source>
        <translation>Vergleich</translation>
    </message>
    <message>
        <source>Compensate noise</source>
        <translation>Rauschen ausgleichen</translation>
    </message>
    <message>
        <source>Confidence exponent p</source>
        <translation>Exponent p der Konfidenz</translation>
    </message>
    <message>
        <source>Contrast limit</source>
        <translation>Kontrastgrenze</translation>
    </message>
    <message>
        <source>Contrast limit, two layers</source>
        <translation>Kontrastgrenze, zwei Schichten</translation>
    </message>
    <message>
        <source>Correct differences in brightness between the views, and their fall-off to the corners, where there are any</source>
        <translation>Gleicht Helligkeitsunterschiede zwischen den Ansichten und ihren Randabfall aus, wo es sie gibt</translation>
    </message>
    <message>
        <source>Relative cost of curvature to jumps in the final denoising</source>
        <translation>Kosten eines Knicks gegenüber denen eines Sprungs im abschließenden Entrauschen</translation>
    </message>
    <message>
        <source>Cost of a jump by one label between neighbors, as a multiple of K; three times as much where they have the same color</source>
        <translation>Kosten eines Sprungs um ein Label zwischen Nachbarn, als Vielfaches von K; das Dreifache, wo sie gleiche Farbe haben</translation>
    </message>
    <message>
        <source>Cost of a line that meets something farther, which violates the ordering</source>
        <translation>Kosten einer Linie, die auf Ferneres trifft, was die Ordnung verletzt</translation>
    </message>
    <message>
        <source>Cost of a line that meets something nearer, which occludes its point; at most μ₋</source>
        <translation>Kosten einer Linie, die auf Näheres trifft, das ihren Punkt verdeckt; höchstens μ₋</translation>
    </message>
    <message>
        <source>Cost of a px by which neighbors differ, relative to the cap</source>
        <translation>Kosten eines px, um das sich Nachbarn unterscheiden, relativ zur Kappung</translation>
    </message>
    <message>
        <source>Cost of one pixel of boundary between labels, in units of -log p</source>
        <translation>Kosten eines Pixels Grenze zwischen Labels, in Einheiten von -log p</translation>
    </message>
    <message>
        <source>Cross scale</source>
        <translation>Querskala</translation>
    </message>
    <message>
        <source>Dataset</source>
        <translation>Datensatz</translation>
    </message>
    <message>
        <source>Defaults of the other parameters: tuned, the best known; paper, the method as published. Parameters that are given keep their value</source>
        <translation>Standardwerte der anderen Parameter: abgestimmt, die besten bekannten; veröffentlicht, das Verfahren wie im Artikel. Angegebene Parameter behalten ihren Wert</translation>
    </message>
    <message>
        <source>Denoising stops once the duality gap falls below this fraction of the energy</source>
        <translation>Das Entrauschen endet, sobald die Dualitätslücke unter diesen Bruchteil der Energie fällt</translation>
    </message>
    <message>
        <source>Depth</source>
        <translation>Tiefe</translation>
    </message>
    <message>
        <source>Depth units</source>
        <translation>Tiefeneinheiten</translation>
    </message>
    <message>
        <source>Differences along a line below this are penalized quadratically</source>
        <translation>Unterschiede entlang einer Linie werden darunter quadratisch bestraft</translation>
    </message>
    <message>
        <source>Disparity range</source>
        <translation>Disparitätsbereich</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>Abstand</translation>
    </message>
    <message>
        <source>Divide each view by its gain, as measured against the center</source>
        <translation>Teilt jede Ansicht durch ihre gegen die mittlere gemessene Verstärkung</translation>
    </message>
    <message>
        <source>EPI_L, denoised over all views with occlusion ordering along the lines</source>
        <translation>EPI_L, über alle Ansichten entrauscht, mit Verdeckungsordnung entlang der Linien</translation>
    </message>
    <message>
        <source>EPI_L, denoised view by view with total variation (TV-L2)</source>
        <translation>EPI_L, je Ansicht entrauscht mit totaler Variation (TV-L2)</translation>
    </message>
    <message>
        <source>Edge strength β</source>
        <translation>Kantenstärke β</translation>
    </message>
    <message>
        <source>Equalize</source>
        <translation>Angleichen</translation>
    </message>
    <message>
        <source>Estimates farther than this from the label are treated as outliers</source>
        <translation>Schätzungen, die weiter als dies vom Label entfernt sind, gelten als Ausreißer</translation>
    </message>
    <message>
        <source>Even brightness</source>
        <translation>Helligkeit angleichen</translation>
    </message>
    <message>
        <source>Every other row of an image grid runs from right to left</source>
        <translation>Jede zweite Zeile eines Bildrasters läuft von rechts nach links</translation>
    </message>
    <message>
        <source>Factor by which the foreground of two layers is smoothed more strongly</source>
        <translation>Faktor, um den der Vordergrund zweier Schichten stärker geglättet wird</translation>
    </message>
    <message>
        <source>Features</source>
        <translation>Merkmale</translation>
    </message>
    <message>
        <source>Features that the forest uses: of the image alone, or of disparity as well</source>
        <translation>Merkmale, die der Random Forest nutzt: nur die des Bildes oder auch die der Disparität</translation>
    </message>
    <message>
        <source>Focus plane</source>
        <translation>Fokusebene</translation>
    </message>
    <message>
        <source>Focus plane to bake in: points of this disparity get disparity 0</source>
        <translation>Anzuwendende Fokusebene: Punkte dieser Disparität erhalten Disparität 0</translation>
    </message>
    <message>
        <source>Foreground smoothness</source>
        <translation>Glattheit des Vordergrunds</translation>
    </message>
    <message>
        <source>Frame</source>
        <translation>Einzelbild</translation>
    </message>
    <message>
        <source>Fusion</source>
        <translation>Fusion</translation>
    </message>
    <message>
        <source>Fusion power</source>
        <translation>Exponent der Fusion</translation>
    </message>
    <message>
        <source>Globally optimal labeling from the orientations on epipolar plane images</source>
        <translation>Global optimales Labeling aus den Orientierungen in Epipolarebenenbildern</translation>
    </message>
    <message>
        <source>Globally optimal labeling of the matching costs of ST_AV_L</source>
        <translation>Global optimales Labeling der Vergleichskosten von ST_AV_L</translation>
    </message>
    <message>
        <source>Globally optimal labeling of the matching costs of ST_CH_L</source>
        <translation>Global optimales Labeling der Vergleichskosten von ST_CH_L</translation>
    </message>
    <message>
        <source>Gradients above this are attenuated, so that silhouettes do not drown the texture beside them; 255 = off</source>
        <translation>Stärkere Gradienten werden gedämpft, damit Silhouetten die Textur daneben nicht überdecken; 255 = aus</translation>
    </message>
    <message>
        <source>Grid of views</source>
        <translation>Raster der Ansichten</translation>
    </message>
    <message>
        <source>Horizontal and vertical estimates are averaged with weights coherence^p</source>
        <translation>Horizontale und vertikale Schätzungen werden mit Gewichten Kohärenz^p gemittelt</translation>
    </message>
    <message>
        <source>Have methods take differences of brightness between views as they are, which they otherwise even out where these are measured</source>
        <translation>Lässt den Verfahren Unterschiede der Helligkeit zwischen Ansichten, die sie sonst ausgleichen, wo sie gemessen sind</translation>
    </message>
    <message>
        <source>How far the views on the left, on the right, above and below are from the estimated one. Farther views tell disparities apart better but see less of what is partly occluded</source>
        <translation>Wie weit die Ansichten links, rechts, darüber und darunter von der geschätzten entfernt sind. Fernere Ansichten unterscheiden Disparitäten besser, sehen aber weniger von teilweise Verdecktem</translation>
    </message>
    <message>
        <source>How labels are made consistent: not at all, view by view, along the rays of all views (rayspace), or by minimizing one energy of all views (wsg13; slower, 16 bytes per ray and label)</source>
        <translation>Wie Labels in Einklang gebracht werden: gar nicht, je Ansicht, entlang der Strahlen aller Ansichten (rayspace) oder durch Minimieren einer Energie aller Ansichten (wsg13; langsamer, 16 Byte je Strahl und Label)</translation>
    </message>
    <message>
        <source>How often every label is expanded, at most</source>
        <translation>Wie oft jedes Label höchstens expandiert wird</translation>
    </message>
    <message>
        <source>How one image holds all views</source>
        <translation>Wie ein Bild alle Ansichten enthält</translation>
    </message>
    <message>
        <source>How the disparity is interpolated between labels</source>
        <translation>Wie die Disparität zwischen Labels interpoliert wird</translation>
    </message>
    <message>
        <source>How the disparity is interpolated between labels, from the costs over all views</source>
        <translation>Wie die Disparität zwischen Labels interpoliert wird, aus den Kosten über alle Ansichten</translation>
    </message>
    <message>
        <source>How the disparity is read off the structure tensor</source>
        <translation>Wie die Disparität aus dem Strukturtensor abgelesen wird</translation>
    </message>
    <message>
        <source>How views are interpolated between pixels</source>
        <translation>Wie Ansichten zwischen Pixeln interpoliert werden</translation>
    </message>
    <message>
        <source>Image names</source>
        <translation>Bildnamen</translation>
    </message>
    <message>
        <source>Influence of the distance to the strokes of a label, measured along surfaces</source>
        <translation>Einfluss des Abstands zu den Strichen eines Labels, entlang von Flächen gemessen</translation>
    </message>
    <message>
        <source>Inner corners of a chessboard or ChArUco board, or circles, in a row</source>
        <translation>Innere Ecken eines Schachbretts oder ChArUco-Bretts, oder Kreise, in einer Zeile</translation>
    </message>
    <message>
        <source>Inner scale</source>
        <translation>Innere Skala</translation>
    </message>
    <message>
        <source>Inner scale, two layers</source>
        <translation>Innere Skala, zwei Schichten</translation>
    </message>
    <message>
        <source>Interpolation</source>
        <translation>Interpolation</translation>
    </message>
    <message>
        <source>Iterations</source>
        <translation>Iterationen</translation>
    </message>
    <message>
        <source>Iterations of the labeling</source>
        <translation>Iterationen des Labelings</translation>
    </message>
    <message>
        <source>Keep differences of brightness</source>
        <translation>Unterschiede der Helligkeit behalten</translation>
    </message>
    <message>
        <source>Lenslet</source>
        <translation>Linsenbild</translation>
    </message>
    <message>
        <source>Levels</source>
        <translation>Pegel</translation>
    </message>
    <message>
        <source>Local multi-view stereo over all views</source>
        <translation>Lokales Stereo mit allen Ansichten</translation>
    </message>
    <message>
        <source>Local multi-view stereo over the views of the cross-hair</source>
        <translation>Lokales Stereo mit den Ansichten des Kreuzes</translation>
    </message>
    <message>
        <source>Local orientation of lines on epipolar plane images (structure tensor)</source>
        <translation>Lokale Orientierung von Linien in Epipolarebenenbildern (Strukturtensor)</translation>
    </message>
    <message>
        <source>Maximum cost that one view contributes, so that views in which the point is occluded do not dominate; 0 derives it from the noise of the light field, 2 disables the cap</source>
        <translation>Größte Kosten, die eine Ansicht beiträgt, damit Ansichten, in denen der Punkt verdeckt ist, nicht überwiegen; 0 leitet sie aus dem Rauschen des Lichtfelds ab, 2 schaltet die Kappung aus</translation>
    </message>
    <message>
        <source>Maximum denoising iterations, at full resolution</source>
        <translation>Größte Zahl von Iterationen des Entrauschens, bei voller Auflösung</translation>
    </message>
    <message>
        <source>Maximum depth of a tree</source>
        <translation>Größte Tiefe eines Baums</translation>
    </message>
    <message>
        <source>Maximum iterations</source>
        <translation>Max. Iterationen</translation>
    </message>
    <message>
        <source>Mosaic</source>
        <translation>Mosaik</translation>
    </message>
    <message>
        <source>Name of the array that holds the light field, in a file with several of them</source>
        <translation>Name des Arrays mit dem Lichtfeld, in einer Datei mit mehreren</translation>
    </message>
    <message>
        <source>Near a jump of disparity, give each pixel the disparity of the side whose lines it fits, in half of the views at least</source>
        <translation>Gibt neben einem Disparitätssprung jedem Pixel die Disparität der Seite, zu deren Linien es passt, in mindestens der Hälfte der Ansichten</translation>
    </message>
    <message>
        <source>Nearness</source>
        <translation>Nähe</translation>
    </message>
    <message>
        <source>No pair of neighbors pays for a larger difference than this</source>
        <translation>Kein Paar von Nachbarn zahlt für einen größeren Unterschied</translation>
    </message>
    <message>
        <source>Noise floor</source>
        <translation>Rauschschwelle</translation>
    </message>
    <message>
        <source>Number of equidistant disparities tested</source>
        <translation>Anzahl der geprüften Disparitäten in gleichem Abstand</translation>
    </message>
    <message>
        <source>Number of iterations of the final denoising</source>
        <translation>Anzahl der Iterationen des abschließenden Entrauschens</translation>
    </message>
    <message>
        <source>Number of times every view is fitted to its neighbors; 0 = off</source>
        <translation>Wie oft jede Ansicht an ihre Nachbarn angepasst wird; 0 = aus</translation>
    </message>
    <message>
        <source>Number of times the costs are computed again without the views in which the last result says a point is occluded; 0 = off</source>
        <translation>Wie oft die Kosten neu berechnet werden, ohne die Ansichten, in denen ein Punkt nach dem letzten Ergebnis verdeckt ist; 0 = aus</translation>
    </message>
    <message>
        <source>Number of trees of the forest</source>
        <translation>Anzahl der Bäume des Random Forest</translation>
    </message>
    <message>
        <source>Occlusion μ₊</source>
        <translation>Verdeckung μ₊</translation>
    </message>
    <message>
        <source>Between neighboring points, in any unit; the camera does not depend on it</source>
        <translation>Benachbarter Punkte, in beliebiger Einheit; die Kamera hängt nicht davon ab</translation>
    </message>
    <message>
        <source>Order of views</source>
        <translation>Reihenfolge der Ansichten</translation>
    </message>
    <message>
        <source>Ordering μ₋</source>
        <translation>Ordnung μ₋</translation>
    </message>
    <message>
        <source>Orientation</source>
        <translation>Orientierung</translation>
    </message>
    <message>
        <source>Outer scale</source>
        <translation>Äußere Skala</translation>
    </message>
    <message>
        <source>Outer scale, two layers</source>
        <translation>Äußere Skala, zwei Schichten</translation>
    </message>
    <message>
        <source>Outside two-layer regions the total variation is weighted by exp(−β·|gradient of the view|); 0 ignores image edges</source>
        <translation>Außerhalb zweischichtiger Gebiete wird die totale Variation mit exp(−β·|Gradient der Ansicht|) gewichtet; 0 lässt Bildkanten außer Acht</translation>
    </message>
    <message>
        <source>Place silhouettes</source>
        <translation>Silhouetten setzen</translation>
    </message>
    <message>
        <source>Profile</source>
        <translation>Profil</translation>
    </message>
    <message>
        <source>Radius of the guided filter that averages the costs of neighbors of similar color; 0 = off</source>
        <translation>Radius des geführten Filters, der die Kosten von Nachbarn ähnlicher Farbe mittelt; 0 = aus</translation>
    </message>
    <message>
        <source>Reduce the confidence of estimates where other views show a different color along the line, or where the texture belongs to a neighboring pixel</source>
        <translation>Verringert die Konfidenz von Schätzungen, wo andere Ansichten entlang der Linie eine andere Farbe zeigen oder wo die Textur zu einem Nachbarpixel gehört</translation>
    </message>
    <message>
        <source>Refinement</source>
        <translation>Verfeinerung</translation>
    </message>
    <message>
        <source>Region smoothness</source>
        <translation>Glattheit der Gebiete</translation>
    </message>
    <message>
        <source>Replace occluded</source>
        <translation>Verdecktes ersetzen</translation>
    </message>
    <message>
        <source>Row and column of the view to estimate; auto = center view</source>
        <translation>Zeile und Spalte der zu schätzenden Ansicht; auto = mittlere Ansicht</translation>
    </message>
    <message>
        <source>Rows</source>
        <translation>Zeilen</translation>
    </message>
    <message>
        <source>Rows and columns of views, where the files do not tell: 9x9, or 1x49 for a scan along a line</source>
        <translation>Zeilen und Spalten von Ansichten, wo die Dateien sie nicht nennen: 9x9, oder 1x49 für eine Fahrt entlang einer Linie</translation>
    </message>
    <message>
        <source>ST_AV_L, denoised with total variation (TV-L2)</source>
        <translation>ST_AV_L, entrauscht mit totaler Variation (TV-L2)</translation>
    </message>
    <message>
        <source>ST_CH_L, denoised with total variation (TV-L2)</source>
        <translation>ST_CH_L, entrauscht mit totaler Variation (TV-L2)</translation>
    </message>
    <message>
        <source>Scene reconstruction from five views by graph cuts, with visibility</source>
        <translation>Rekonstruktion aus fünf Ansichten durch Graphenschnitte, mit Sichtbarkeit</translation>
    </message>
    <message>
        <source>Second derivatives above this are attenuated</source>
        <translation>Stärkere zweite Ableitungen werden gedämpft</translation>
    </message>
    <message>
        <source>Seed of the random numbers used to train the forest</source>
        <translation>Startwert der Zufallszahlen, mit denen der Random Forest trainiert wird</translation>
    </message>
    <message>
        <source>Shear step</source>
        <translation>Scherungsschritt</translation>
    </message>
    <message>
        <source>Smoothing</source>
        <translation>Glättung</translation>
    </message>
    <message>
        <source>Smoothing λ</source>
        <translation>Glättung λ</translation>
    </message>
    <message>
        <source>Smoothness</source>
        <translation>Glattheit</translation>
    </message>
    <message>
        <source>Smoothness λ</source>
        <translation>Glattheit λ</translation>
    </message>
    <message>
        <source>Snake</source>
        <translation>Schlangenlinie</translation>
    </message>
    <message>
        <source>Spacing of the shears that bring every line close to upright before its orientation is measured; rounded to half pixels; 0 = whole pixels, and only if the range exceeds ±1.2 px</source>
        <translation>Abstand der Scherungen, die jede Linie nahezu aufrichten, bevor ihre Orientierung gemessen wird; auf halbe Pixel gerundet; 0 = ganze Pixel, und nur wenn der Bereich über ±1.2 px hinausgeht</translation>
    </message>
    <message>
        <source>Standard deviation of the Gaussian applied to the samples before derivatives</source>
        <translation>Standardabweichung der Gauß-Funktion, mit der die Samples vor den Ableitungen geglättet werden</translation>
    </message>
    <message>
        <source>Standard deviation of the Gaussian applied to the samples before second derivatives</source>
        <translation>Standardabweichung der Gauß-Funktion, mit der die Samples vor den zweiten Ableitungen geglättet werden</translation>
    </message>
    <message>
        <source>Standard deviation of the Gaussian window over which orientation is averaged, along the EPI</source>
        <translation>Standardabweichung des Gauß-Fensters, über das die Orientierung entlang des EPI gemittelt wird</translation>
    </message>
    <message>
        <source>Standard deviation of the Gaussian window over which two orientations are averaged, along the EPI</source>
        <translation>Standardabweichung des Gauß-Fensters, über das zwei Orientierungen entlang des EPI gemittelt werden</translation>
    </message>
    <message>
        <source>Standard deviation of the same window across neighboring EPIs</source>
        <translation>Standardabweichung desselben Fensters quer über benachbarte EPIs</translation>
    </message>
    <message>
        <source>Standard deviation of the same window along the views</source>
        <translation>Standardabweichung desselben Fensters entlang der Ansichten</translation>
    </message>
    <message>
        <source>Step</source>
        <translation>Schritt</translation>
    </message>
    <message>
        <source>Stop at gap</source>
        <translation>Ende bei Lücke</translation>
    </message>
    <message>
        <source>Strength of the TV-L2 smoothing that places disparities between labels afterwards, in label steps; 0 keeps the labels, as in the paper</source>
        <translation>Stärke der TV-L2-Glättung, die Disparitäten danach zwischen Labels setzt, in Label-Schritten; 0 behält die Labels, wie im Artikel</translation>
    </message>
    <message>
        <source>Strength of the final denoising with TGV²; 0 = off</source>
        <translation>Stärke des abschließenden Entrauschens mit TGV²; 0 = aus</translation>
    </message>
    <message>
        <source>Sweeps</source>
        <translation>Durchgänge</translation>
    </message>
    <message>
        <source>Texture with less contrast than this loses confidence</source>
        <translation>Textur mit weniger Kontrast verliert an Konfidenz</translation>
    </message>
    <message>
        <source>The cap of a pixel follows what a disparity that is off by this much costs there; 0 uses ε for all pixels</source>
        <translation>Die Kappung eines Pixels folgt dem, was eine um diesen Wert falsche Disparität dort kostet; 0 nimmt ε für alle Pixel</translation>
    </message>
    <message>
        <source>The data term is weighted by coherence^p</source>
        <translation>Der Datenterm wird mit Kohärenz^p gewichtet</translation>
    </message>
    <message>
        <source>The data term is weighted by coherence^p, for two layers by their confidence^p; 0 weights all pixels equally</source>
        <translation>Der Datenterm wird mit Kohärenz^p gewichtet, bei zwei Schichten mit deren Konfidenz^p; 0 gewichtet alle Pixel gleich</translation>
    </message>
    <message>
        <source>The data term is weighted by confidence^p; 0 weights all pixels equally, as in the paper</source>
        <translation>Der Datenterm wird mit Konfidenz^p gewichtet; 0 gewichtet alle Pixel gleich, wie im Artikel</translation>
    </message>
    <message>
        <source>The labeling stops once its energy is proven to be within this fraction of the minimum</source>
        <translation>Das Labeling endet, sobald seine Energie nachweislich höchstens um diesen Bruchteil über dem Minimum liegt</translation>
    </message>
    <message>
        <source>The smallest cap of a pixel, as a share of ε</source>
        <translation>Kleinste Kappung eines Pixels, als Anteil von ε</translation>
    </message>
    <message>
        <source>The smallest weight of a pair of neighbors</source>
        <translation>Kleinstes Gewicht eines Paars von Nachbarn</translation>
    </message>
    <message>
        <source>Inner corners, or circles, in a column</source>
        <translation>Innere Ecken oder Kreise in einer Spalte</translation>
    </message>
    <message>
        <source>The total variation is weighted by exp(−β·|gradient of the view|); 0 ignores image edges, as in the paper</source>
        <translation>Die totale Variation wird mit exp(−β·|Gradient der Ansicht|) gewichtet; 0 lässt Bildkanten außer Acht, wie im Artikel</translation>
    </message>
    <message>
        <source>Trees</source>
        <translation>Bäume</translation>
    </message>
    <message>
        <source>Truncation T</source>
        <translation>Kappung T</translation>
    </message>
    <message>
        <source>Truncation κ</source>
        <translation>Kappung κ</translation>
    </message>
    <message>
        <source>Two layers are assumed where the misfit of one orientation exceeds this fraction of the misfits of one and of two orientations together</source>
        <translation>Zwei Schichten werden angenommen, wo der Restfehler einer Orientierung diesen Bruchteil der Restfehler von einer und zwei Orientierungen zusammen übersteigt</translation>
    </message>
    <message>
        <source>Two layers closer to each other than this are treated as one</source>
        <translation>Zwei Schichten, die einander näher sind, gelten als eine</translation>
    </message>
    <message>
        <source>Two pixels can see the same point if their squared difference, the mean over the channels, is less; 0 finds it by the rule below</source>
        <translation>Zwei Pixel können denselben Punkt sehen, wenn ihr quadrierter Unterschied, gemittelt über die Kanäle, kleiner ist; 0 ermittelt die Grenze nach der Regel darunter</translation>
    </message>
    <message>
        <source>Two superimposed orientations on epipolar plane images: transparent and reflective surfaces</source>
        <translation>Zwei überlagerte Orientierungen in Epipolarebenenbildern: durchsichtige und spiegelnde Flächen</translation>
    </message>
    <message>
        <source>View</source>
        <translation>Ansicht</translation>
    </message>
    <message>
        <source>View axes to reverse relative to the file; auto = detected and checked</source>
        <translation>Achsen der Ansichten, die gegenüber der Datei umzukehren sind; auto = ermittelt und geprüft</translation>
    </message>
    <message>
        <source>View scale</source>
        <translation>Ansichtsskala</translation>
    </message>
    <message>
        <source>Views to keep</source>
        <translation>Behaltene Ansichten</translation>
    </message>
    <message>
        <source>Weight of the length of the boundary between one layer and two; regions narrower than twice this are dropped</source>
        <translation>Gewicht der Länge der Grenze zwischen einer Schicht und zweien; Gebiete, die schmaler sind als das Doppelte, fallen weg</translation>
    </message>
    <message>
        <source>Weight of the total variation of both layers; larger values are smoother</source>
        <translation>Gewicht der totalen Variation beider Schichten; größere Werte glätten mehr</translation>
    </message>
    <message>
        <source>Weight of the total variation per px of disparity, relative to the mean matching cost within half a pixel of the best label (stereo) or the mean confidence weight (EPI_G), so that it depends on neither labels nor range nor contrast</source>
        <translation>Gewicht der totalen Variation je px Disparität, relativ zu den mittleren Vergleichskosten bis ein halbes Pixel neben dem besten Label (Stereo) oder zum mittleren Konfidenzgewicht (EPI_G), sodass es weder von Labels noch von Bereich noch von Kontrast abhängt</translation>
    </message>
    <message>
        <source>Weight of the total variation; larger values are smoother</source>
        <translation>Gewicht der totalen Variation; größere Werte glätten mehr</translation>
    </message>
    <message>
        <source>What the photographs show</source>
        <translation>Was die Fotos zeigen</translation>
    </message>
    <message>
        <source>Where neighboring disparities scatter less than this, in px, the data term gets more weight, so that slopes are not flattened; 0 treats all pixels alike, as in the paper</source>
        <translation>Wo benachbarte Disparitäten weniger streuen als dies, in px, erhält der Datenterm mehr Gewicht, damit Schrägen nicht abgeflacht werden; 0 behandelt alle Pixel gleich, wie im Artikel</translation>
    </message>
    <message>
        <source>Whether dH of an archive file includes the factor xRes, which determines how depth is converted to disparity</source>
        <translation>Ob dH einer Archivdatei den Faktor xRes enthält, der bestimmt, wie Tiefe in Disparität umgerechnet wird</translation>
    </message>
    <message>
        <source>Whether views are compared at the nearest pixels or interpolated between them</source>
        <translation>Ob Ansichten an den nächstgelegenen Pixeln verglichen oder zwischen ihnen interpoliert werden</translation>
    </message>
    <message>
        <source>Which light field of a sequence to open, from 0</source>
        <translation>Welches Lichtfeld einer Sequenz zu öffnen ist, von 0 an</translation>
    </message>
    <message>
        <source>Whole file names of the views, with {row} and {col} or {index} for the numbers, {y} and {x} for positions, * for anything and ? for one character: view_{row}_{col}.png; or re: and a regular expression with groups of these names: re:(?&lt;row&gt;[0-9]+)of(?&lt;col&gt;[0-9]+).*</source>
        <translation>Ganze Dateinamen der Ansichten, mit {row} und {col} oder {index} für die Nummern, {y} und {x} für Positionen, * für Beliebiges und ? für ein Zeichen: view_{row}_{col}.png; oder re: und ein regulärer Ausdruck mit Gruppen dieser Namen: re:(?&lt;row&gt;[0-9]+)of(?&lt;col&gt;[0-9]+).*</translation>
    </message>
    <message>
        <source>a plane slanted from -1 px to 1 px</source>
        <translation>eine schräge Ebene von −1 px bis 1 px</translation>
    </message>
    <message>
        <source>a semi-transparent pane in front of a plane, with ground truth for both layers</source>
        <translation>eine halbdurchsichtige Scheibe vor einer Ebene, mit Referenz für beide Schichten</translation>
    </message>
    <message>
        <source>a sphere and a box on the ground, with labels and scribbles</source>
        <translation>eine Kugel und eine Kiste auf dem Boden, mit Labels und Strichen</translation>
    </message>
    <message>
        <source>a still life: vase with flowers, balls, box, cone and can on a table</source>
        <translation>ein Stillleben: Vase mit Blumen, Bälle, Kiste, Kegel und Dose auf einem Tisch</translation>
    </message>
    <message>
        <source>absolute</source>
        <translation>absolut</translation>
    </message>
    <message>
        <source>absolute: samples are compared as they are; relative: relative to the mean around them, for views of different brightness</source>
        <translation>absolut: Samples werden unverändert verglichen; relativ: relativ zum Mittel um sie herum, für Ansichten verschiedener Helligkeit</translation>
    </message>
    <message>
        <source>any</source>
        <translation>any</translation>
    </message>
    <message>
        <source>arranging the views of the list</source>
        <translation>Ansichten der Liste werden angeordnet</translation>
    </message>
    <message>
        <source>as stored</source>
        <translation>wie gespeichert</translation>
    </message>
    <message>
        <source>automatic: detected and checked</source>
        <translation>automatisch: ermittelt und geprüft</translation>
    </message>
    <message>
        <source>automatic: whichever is plausible</source>
        <translation>automatisch: was plausibel ist</translation>
    </message>
    <message>
        <source>between labels</source>
        <translation>zwischen Labels</translation>
    </message>
    <message>
        <source>between pixels</source>
        <translation>zwischen Pixeln</translation>
    </message>
    <message>
        <source>bilinear</source>
        <translation>bilinear</translation>
    </message>
    <message>
        <source>both reversed</source>
        <translation>beide umgekehrt</translation>
    </message>
    <message>
        <source>calibrating</source>
        <translation>Kalibrierung</translation>
    </message>
    <message>
        <source>propagating to other views</source>
        <translation>Übertragung in andere Ansichten</translation>
    </message>
    <message>
        <source>charuco</source>
        <translation>ChArUco</translation>
    </message>
    <message>
        <source>checking lines</source>
        <translation>Prüfung der Linien</translation>
    </message>
    <message>
        <source>checking lines and denoising</source>
        <translation>Prüfung der Linien und Entrauschen</translation>
    </message>
    <message>
        <source>checking the order of views</source>
        <translation>Prüfung der Reihenfolge der Ansichten</translation>
    </message>
    <message>
        <source>chessboard</source>
        <translation>Schachbrett</translation>
    </message>
    <message>
        <source>circles</source>
        <translation>Kreise</translation>
    </message>
    <message>
        <source>columns (u) reversed</source>
        <translation>Spalten (u) umgekehrt</translation>
    </message>
    <message>
        <source>cubic</source>
        <translation>kubisch</translation>
    </message>
    <message>
        <source>dH does not include the image width</source>
        <translation>dH enthält die Bildbreite nicht</translation>
    </message>
    <message>
        <source>dH includes the image width</source>
        <translation>dH enthält die Bildbreite</translation>
    </message>
    <message>
        <source>dark</source>
        <translation>dunkel</translation>
    </message>
    <message>
        <source>dark and bright bars before a wall, with less and less texture downwards</source>
        <translation>dunkle und helle Balken vor einer Wand, mit immer weniger Textur nach unten</translation>
    </message>
    <message>
        <source>data term</source>
        <translation>Datenterm</translation>
    </message>
    <message>
        <source>denoising</source>
        <translation>Entrauschen</translation>
    </message>
    <message>
        <source>disparity range</source>
        <translation>Disparitätsbereich</translation>
    </message>
    <message>
        <source>dots of eight sizes before a wall, under noise that grows downwards</source>
        <translation>Punkte in acht Größen vor einer Wand, unter Rauschen, das nach unten zunimmt</translation>
    </message>
    <message>
        <source>edge weights</source>
        <translation>Kantengewichte</translation>
    </message>
    <message>
        <source>eigenvector</source>
        <translation>Eigenvektor</translation>
    </message>
    <message>
        <source>equiangular</source>
        <translation>gleichwinklig</translation>
    </message>
    <message>
        <source>finding edges</source>
        <translation>Suche nach Kanten</translation>
    </message>
    <message>
        <source>finding the axes of the gantry</source>
        <translation>Suche nach den Achsen des Kameraportals</translation>
    </message>
    <message>
        <source>graph cuts</source>
        <translation>Graphenschnitte</translation>
    </message>
    <message>
        <source>horizontal EPIs</source>
        <translation>horizontale EPIs</translation>
    </message>
    <message>
        <source>ignore</source>
        <translation>außer Acht lassen</translation>
    </message>
    <message>
        <source>image</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>labeling</source>
        <translation>Labeling</translation>
    </message>
    <message>
        <source>labeling neighboring views</source>
        <translation>Labeling benachbarter Ansichten</translation>
    </message>
    <message>
        <source>layers</source>
        <translation>Schichten</translation>
    </message>
    <message>
        <source>least</source>
        <translation>kleinste</translation>
    </message>
    <message>
        <source>least squares</source>
        <translation>kleinste Quadrate</translation>
    </message>
    <message>
        <source>lenslets side by side (ESLF)</source>
        <translation>Linsenbilder nebeneinander (ESLF)</translation>
    </message>
    <message>
        <source>lines</source>
        <translation>Linien</translation>
    </message>
    <message>
        <source>looking for dark views</source>
        <translation>Suche nach dunklen Ansichten</translation>
    </message>
    <message>
        <source>looking for light fields</source>
        <translation>Suche nach Lichtfeldern</translation>
    </message>
    <message>
        <source>looking for rows and columns</source>
        <translation>Suche nach Zeilen und Spalten</translation>
    </message>
    <message>
        <source>matching costs</source>
        <translation>Vergleichskosten</translation>
    </message>
    <message>
        <source>noise</source>
        <translation>Rauschen</translation>
    </message>
    <message>
        <source>noise: three times the least difference of a pixel at any label, the median over pixels, at least 30; quarter: the mean of what a quarter of the labels fall below</source>
        <translation>Rauschen: das Dreifache des kleinsten Unterschieds eines Pixels bei beliebigem Label, im Median über die Pixel, mindestens 30; Viertel: der Mittelwert dessen, worunter ein Viertel der Labels fällt</translation>
    </message>
    <message>
        <source>noisy</source>
        <translation>verrauscht</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>occlusion</source>
        <translation>Verdeckung</translation>
    </message>
    <message>
        <source>one plane of disparity 0.37 px</source>
        <translation>eine Ebene mit Disparität 0.37 px</translation>
    </message>
    <message>
        <source>orientations</source>
        <translation>Orientierungen</translation>
    </message>
    <message>
        <source>paper</source>
        <translation>veröffentlicht</translation>
    </message>
    <message>
        <source>parabola</source>
        <translation>Parabel</translation>
    </message>
    <message>
        <source>periodic</source>
        <translation>periodisch</translation>
    </message>
    <message>
        <source>photographing the pattern</source>
        <translation>Muster wird fotografiert</translation>
    </message>
    <message>
        <source>plain</source>
        <translation>schlicht</translation>
    </message>
    <message>
        <source>probabilities (depth)</source>
        <translation>Wahrscheinlichkeiten (Tiefe)</translation>
    </message>
    <message>
        <source>probabilities (image)</source>
        <translation>Wahrscheinlichkeiten (Bild)</translation>
    </message>
    <message>
        <source>probabilities (true depth)</source>
        <translation>Wahrscheinlichkeiten (wahre Tiefe)</translation>
    </message>
    <message>
        <source>px</source>
        <translation>px</translation>
    </message>
    <message>
        <source>pyramids, a ball and a bowl on a wall</source>
        <translation>Pyramiden, eine Kugel und eine Schale an einer Wand</translation>
    </message>
    <message>
        <source>quarter of the labels</source>
        <translation>Viertel der Labels</translation>
    </message>
    <message>
        <source>rays</source>
        <translation>Strahlen</translation>
    </message>
    <message>
        <source>rayspace</source>
        <translation>rayspace</translation>
    </message>
    <message>
        <source>reading depth</source>
        <translation>Tiefe wird gelesen</translation>
    </message>
    <message>
        <source>reading labels</source>
        <translation>Labels werden gelesen</translation>
    </message>
    <message>
        <source>reading maps</source>
        <translation>Karten werden gelesen</translation>
    </message>
    <message>
        <source>reading the picture</source>
        <translation>Bild wird gelesen</translation>
    </message>
    <message>
        <source>reading views</source>
        <translation>Ansichten werden gelesen</translation>
    </message>
    <message>
        <source>regularizing</source>
        <translation>Regularisierung</translation>
    </message>
    <message>
        <source>relative</source>
        <translation>relativ</translation>
    </message>
    <message>
        <source>resampling</source>
        <translation>Neuabtastung</translation>
    </message>
    <message>
        <source>room</source>
        <translation>Raum</translation>
    </message>
    <message>
        <source>rows (v) reversed</source>
        <translation>Zeilen (v) umgekehrt</translation>
    </message>
    <message>
        <source>settling between labels</source>
        <translation>Einpendeln zwischen Labels</translation>
    </message>
    <message>
        <source>shiny</source>
        <translation>glänzend</translation>
    </message>
    <message>
        <source>smooth</source>
        <translation>glatt</translation>
    </message>
    <message>
        <source>splitting the picture into views</source>
        <translation>Bild wird in Ansichten zerlegt</translation>
    </message>
    <message>
        <source>sum</source>
        <translation>Summe</translation>
    </message>
    <message>
        <source>sum: horizontal and vertical estimates both count, each truncated; least: the one that is nearer to the label counts</source>
        <translation>Summe: horizontale und vertikale Schätzungen zählen beide, jede gekappt; kleinste: die dem Label nähere zählt</translation>
    </message>
    <message>
        <source>teeth before a wall, from a small step at the top to a large one</source>
        <translation>Zähne vor einer Wand, von einer kleinen Stufe oben bis zu einer großen</translation>
    </message>
    <message>
        <source>telling rows from columns of views</source>
        <translation>Zeilen und Spalten von Ansichten werden unterschieden</translation>
    </message>
    <message>
        <source>there is no NVIDIA driver</source>
        <translation>es gibt keinen NVIDIA-Treiber</translation>
    </message>
    <message>
        <source>thin</source>
        <translation>dünn</translation>
    </message>
    <message>
        <source>thin bars of 1, 2, 3 and 5 px in front of a plane</source>
        <translation>dünne Stäbe von 1, 2, 3 und 5 px vor einer Ebene</translation>
    </message>
    <message>
        <source>this build has no CUDA</source>
        <translation>dieses Programm wurde ohne CUDA erstellt</translation>
    </message>
    <message>
        <source>tuned</source>
        <translation>abgestimmt</translation>
    </message>
    <message>
        <source>two orientations</source>
        <translation>zwei Orientierungen</translation>
    </message>
    <message>
        <source>two orientations, horizontal EPIs</source>
        <translation>zwei Orientierungen, horizontale EPIs</translation>
    </message>
    <message>
        <source>two orientations, vertical EPIs</source>
        <translation>zwei Orientierungen, vertikale EPIs</translation>
    </message>
    <message>
        <source>two planes, -0.5 px and 0.8 px, with a straight vertical edge</source>
        <translation>zwei Ebenen, −0.5 px und 0.8 px, mit einer geraden senkrechten Kante</translation>
    </message>
    <message>
        <source>uneven</source>
        <translation>ungleichmäßig</translation>
    </message>
    <message>
        <source>use</source>
        <translation>nutzen</translation>
    </message>
    <message>
        <source>use: views are sampled at the positions that files state, if they match better there; ignore: on the regular grid</source>
        <translation>nutzen: Ansichten werden an den Positionen abgetastet, die die Dateien nennen, falls sie dort besser passen; außer Acht lassen: auf dem regelmäßigen Raster</translation>
    </message>
    <message>
        <source>vertical EPIs</source>
        <translation>vertikale EPIs</translation>
    </message>
    <message>
        <source>view</source>
        <translation>je Ansicht</translation>
    </message>
    <message>
        <source>view steps</source>
        <translation>Ansichtsschritte</translation>
    </message>
    <message>
        <source>views</source>
        <translation>Ansichten</translation>
    </message>
    <message>
        <source>views side by side</source>
        <translation>Ansichten nebeneinander</translation>
    </message>
    <message>
        <source>weighted</source>
        <translation>gewichtet</translation>
    </message>
    <message>
        <source>weighted: horizontal and vertical estimates that agree are averaged; winner: the more coherent one is taken</source>
        <translation>gewichtet: übereinstimmende horizontale und vertikale Schätzungen werden gemittelt; Gewinner: die kohärentere wird genommen</translation>
    </message>
    <message>
        <source>whole pixels</source>
        <translation>ganze Pixel</translation>
    </message>
    <message>
        <source>winner</source>
        <translation>Gewinner</translation>
    </message>
    <message>
        <source>wsg13</source>
        <translation>wsg13</translation>
    </message>
    <message>
        <source>reading the pictures</source>
        <translation>Bilder werden gelesen</translation>
    </message>
    <message>
        <source>One or two pixels nearer than all their neighbors, or farther, take the median of these; off, as in the paper</source>
        <translation>Ein oder zwei Pixel, die näher oder ferner sind als alle Nachbarn, nehmen deren Median an; aus: wie im Artikel</translation>
    </message>
    <message>
        <source>aliased</source>
        <translation>unterabgetastet</translation>
    </message>
    <message>
        <source>an unknown error occurred</source>
        <translation>ein unbekannter Fehler ist aufgetreten</translation>
    </message>
    <message>
        <source>2016 benchmark folder</source>
        <translation>Ordner des Benchmarks von 2016</translation>
    </message>
    <message>
        <source>archive excerpt (lf, depth.bin)</source>
        <translation>Auszug des Archivs (lf, depth.bin)</translation>
    </message>
    <message>
        <source>built-in scene</source>
        <translation>eingebaute Szene</translation>
    </message>
    <message>
        <source>canonical order</source>
        <translation>kanonisch</translation>
    </message>
    <message>
        <source>depth ignored</source>
        <translation>Tiefe nicht benutzt</translation>
    </message>
    <message>
        <source>exact by construction</source>
        <translation>exakt erzeugt</translation>
    </message>
    <message>
        <source>exact disparity by eq. 1</source>
        <translation>exakt nach Gl. 1</translation>
    </message>
    <message>
        <source>float32 as stored, taken as linear; estimators see the values</source>
        <translation>float32 wie gespeichert, gilt als linear; Verfahren sehen die Werte</translation>
    </message>
    <message>
        <source>no depth in a mosaic</source>
        <translation>keine Tiefe in einem Mosaik</translation>
    </message>
    <message>
        <source>no depth in an image grid</source>
        <translation>keine Tiefe in einem Bildraster</translation>
    </message>
    <message>
        <source>no depth in such a file</source>
        <translation>keine Tiefe in einer solchen Datei</translation>
    </message>
    <message>
        <source>no depth in this file</source>
        <translation>keine Tiefe in dieser Datei</translation>
    </message>
    <message>
        <source>no valid depth</source>
        <translation>keine gültige Tiefe</translation>
    </message>
    <message>
        <source>not enough memory; close other programs or use smaller data</source>
        <translation>Der Speicher reicht nicht; andere Programme schließen oder kleinere Daten verwenden</translation>
    </message>
    <message>
        <source>not known: the views are too dark, too bright or too small to compare</source>
        <translation>nicht bekannt: die Ansichten sind zu dunkel, zu hell oder zu klein für einen Vergleich</translation>
    </message>
    <message>
        <source>not measured, since that would read the whole file</source>
        <translation>nicht gemessen, da dafür die ganze Datei zu lesen wäre</translation>
    </message>
    <message>
        <source>the file states this formula</source>
        <translation>die Datei nennt diese Formel</translation>
    </message>
    <message>
        <source>u and v reversed</source>
        <translation>u und v umgekehrt</translation>
    </message>
    <message>
        <source>u reversed</source>
        <translation>u umgekehrt</translation>
    </message>
    <message>
        <source>uint16 as stored, taken as gamma-encoded; estimators see value/65535</source>
        <translation>uint16 wie gespeichert, gilt als gammakodiert; Verfahren sehen Wert/65535</translation>
    </message>
    <message>
        <source>uint8 as stored, taken as gamma-encoded; estimators see value/255</source>
        <translation>uint8 wie gespeichert, gilt als gammakodiert; Verfahren sehen Wert/255</translation>
    </message>
    <message>
        <source>v reversed</source>
        <translation>v umgekehrt</translation>
    </message>
    <message>
        <source>refinement</source>
        <translation>Verfeinerung</translation>
    </message>
    <message>
        <source>selection</source>
        <translation>Auswahl</translation>
    </message>
    <message>
        <source>volume</source>
        <translation>Volumen</translation>
    </message>
    <message>
        <source>A network chooses and refines disparities by the evidence of all views</source>
        <translation>Ein Netz wählt und verfeinert Disparitäten nach dem, was alle Ansichten belegen</translation>
    </message>
    <message>
        <source>Bring all views to the brightness of the center view</source>
        <translation>Gleicht alle Ansichten der Helligkeit der mittleren an</translation>
    </message>
    <message>
        <source>File of the network&apos;s weights; by default those of the program</source>
        <translation>Datei mit den Gewichten des Netzes; sonst die des Programms</translation>
    </message>
    <message>
        <source>Rounds in which each pixel chooses among the disparities around it</source>
        <translation>Runden, in denen jedes Pixel unter den Disparitäten seiner Umgebung wählt</translation>
    </message>
    <message>
        <source>Row and column of the view to estimate, or to begin with; auto = center view</source>
        <translation>Zeile und Spalte der Ansicht, die geschätzt wird oder mit der begonnen wird; auto = mittlere Ansicht</translation>
    </message>
    <message>
        <source>Rows and columns of views to keep around the center: 9x9, or all; empty = the largest grid whose views are filled</source>
        <translation>Zeilen und Spalten der Ansichten, die um die Mitte bleiben: 9x9, oder all für alle; leer = das größte Raster mit vollen Ansichten</translation>
    </message>
    <message>
        <source>Silhouettes</source>
        <translation>Silhouetten</translation>
    </message>
    <message>
        <source>Values of black and white samples as stored: 0,1023 for 10 bits in 16, -1,1 for normalized floats; empty = detected</source>
        <translation>Werte von Schwarz und Weiß, wie gespeichert: 0,1023 für 10 von 16 Bit, -1,1 für normalisierte Gleitkommazahlen; leer = erkannt</translation>
    </message>
    <message>
        <source>Weights</source>
        <translation>Gewichte</translation>
    </message>
    <message>
        <source>Where a pixel shows two surfaces: mode, the more probable one; mean, the mean of both by their shares, which has the smaller squared error</source>
        <translation>Wo ein Pixel zwei Flächen zeigt: Modus, die wahrscheinlichere; Mittel, beide nach ihren Anteilen gemittelt, was den kleineren quadratischen Fehler hat</translation>
    </message>
    <message>
        <source>faint</source>
        <translation>schwach</translation>
    </message>
    <message>
        <source>comparing the brightness of views</source>
        <translation>Helligkeit der Ansichten wird verglichen</translation>
    </message>
    <message>
        <source>Aggregation radius</source>
        <translation>Radius der Mittelung</translation>
    </message>
    <message>
        <source>Automatic limit K</source>
        <translation>Schranke K automatisch</translation>
    </message>
    <message>
        <source>Camera positions</source>
        <translation>Kamerapositionen</translation>
    </message>
    <message>
        <source>Combine directions</source>
        <translation>Richtungen verbinden</translation>
    </message>
    <message>
        <source>Compare samples</source>
        <translation>Abtastwerte vergleichen</translation>
    </message>
    <message>
        <source>Cost cap offset</source>
        <translation>Zuschlag zur Kappung</translation>
    </message>
    <message>
        <source>Cost cap ε</source>
        <translation>Kappung der Kosten ε</translation>
    </message>
    <message>
        <source>Curvature cost</source>
        <translation>Kosten der Krümmung</translation>
    </message>
    <message>
        <source>Denoising iterations</source>
        <translation>Iterationen des Entrauschens</translation>
    </message>
    <message>
        <source>Equalize brightness</source>
        <translation>Helligkeit angleichen</translation>
    </message>
    <message>
        <source>Final denoising</source>
        <translation>Abschließendes Entrauschen</translation>
    </message>
    <message>
        <source>Map noise σ₀</source>
        <translation>Rauschen der Karte σ₀</translation>
    </message>
    <message>
        <source>Match limit K</source>
        <translation>Schranke der Übereinstimmung K</translation>
    </message>
    <message>
        <source>Maximum cycles</source>
        <translation>Höchstzahl der Durchläufe</translation>
    </message>
    <message>
        <source>Maximum jump</source>
        <translation>Größter Sprung</translation>
    </message>
    <message>
        <source>Minimum cost cap</source>
        <translation>Kleinste Kappung der Kosten</translation>
    </message>
    <message>
        <source>Minimum layer distance</source>
        <translation>Kleinster Abstand der Schichten</translation>
    </message>
    <message>
        <source>Minimum neighbor weight</source>
        <translation>Kleinstes Gewicht eines Nachbarn</translation>
    </message>
    <message>
        <source>Occluder confidence</source>
        <translation>Konfidenz des Verdeckenden</translation>
    </message>
    <message>
        <source>Occlusion tolerance</source>
        <translation>Toleranz bei Verdeckung</translation>
    </message>
    <message>
        <source>Quadratic below</source>
        <translation>Quadratisch unter</translation>
    </message>
    <message>
        <source>Refinement rounds</source>
        <translation>Runden der Verfeinerung</translation>
    </message>
    <message>
        <source>Regions whose mean confidence is below this are uncertain: denoising places their pixels by what each says by itself, if that is elsewhere; 0 = none</source>
        <translation>Regionen mit kleinerer mittlerer Konfidenz sind unsicher: Das Entrauschen setzt ihre Pixel nach dem, was jedes für sich sagt, wenn das anderswo liegt; 0 = keine</translation>
    </message>
    <message>
        <source>Remove specks</source>
        <translation>Flecken entfernen</translation>
    </message>
    <message>
        <source>Side view distance</source>
        <translation>Abstand der Seitenansichten</translation>
    </message>
    <message>
        <source>Smoothing between labels</source>
        <translation>Glättung zwischen Stufen</translation>
    </message>
    <message>
        <source>Two-layer threshold</source>
        <translation>Schwelle für zwei Schichten</translation>
    </message>
    <message>
        <source>Uncertain below</source>
        <translation>Unsicher unter</translation>
    </message>
    <message>
        <source>Uncertain pixels keep their label where denoising moves them by no more than this</source>
        <translation>Unsichere Pixel behalten ihre Stufe, wo das Entrauschen sie um höchstens so viel verschiebt</translation>
    </message>
    <message>
        <source>Uncertain: tolerance</source>
        <translation>Unsicher: Toleranz</translation>
    </message>
    <message>
        <source>Visibility rounds</source>
        <translation>Runden der Sichtbarkeit</translation>
    </message>
    <message>
        <source>a pixel right of a lens&apos;s center sees from the right</source>
        <translation>ein Pixel rechts der Linsenmitte sieht von rechts</translation>
    </message>
    <message>
        <source>finding the lenses</source>
        <translation>Linsen finden</translation>
    </message>
    <message>
        <source>one line of views, rows from the bottom (quilt)</source>
        <translation>eine Reihe von Ansichten, Zeilen von unten (Quilt)</translation>
    </message>
    <message>
        <source>removing vignetting</source>
        <translation>Randabschattung entfernen</translation>
    </message>
    <message>
        <source>sampling views</source>
        <translation>Ansichten abtasten</translation>
    </message>
    <message>
        <source>views side by side, rows from the bottom</source>
        <translation>Ansichten nebeneinander, Zeilen von unten</translation>
    </message>
    <message>
        <source>At depth jumps, take the median of the neighbors, weighted by similarity of color</source>
        <translation>An Tiefensprüngen den Median der Nachbarn nehmen, gewichtet nach Ähnlichkeit der Farbe</translation>
    </message>
    <message>
        <source>Multi-view stereo over visible views, refined by TGV, propagated to all views</source>
        <translation>Stereo über sichtbare Ansichten, verfeinert durch TGV, auf alle Ansichten übertragen</translation>
    </message>
    <message>
        <source>Pixels from one lenslet of a mosaic to the next; of a fraction, as 15.38, the picture is resampled to lenslets of whole pixels; 0 = detected</source>
        <translation>Pixel von einer Linse eines Mosaiks zur nächsten; bei einem Bruch wie 15.38 wird das Bild auf Linsen ganzer Pixel umgetastet; 0 = erkannt</translation>
    </message>
    <message>
        <source>processed container of a Lytro camera</source>
        <translation>Container fertiger Bilder einer Lytro-Kamera</translation>
    </message>
    <message>
        <source>depth map</source>
        <translation>Tiefenkarte</translation>
    </message>
    <message>
        <source>depth maps</source>
        <translation>Tiefenkarten</translation>
    </message>
    <message>
        <source>label file</source>
        <translation>Labeldatei</translation>
    </message>
    <message>
        <source>label files</source>
        <translation>Labeldateien</translation>
    </message>
    <message>
        <source>label picture</source>
        <translation>Labelbild</translation>
    </message>
    <message>
        <source>label pictures</source>
        <translation>Labelbilder</translation>
    </message>
    <message>
        <source>light field</source>
        <translation>Lichtfeld</translation>
    </message>
    <message>
        <source>manifest</source>
        <translation>Manifest</translation>
    </message>
    <message>
        <source>mosaic</source>
        <translation>Mosaik</translation>
    </message>
    <message>
        <source>mosaics</source>
        <translation>Mosaike</translation>
    </message>
    <message>
        <source>parameter file</source>
        <translation>Parameterdatei</translation>
    </message>
    <message>
        <source>parameter files</source>
        <translation>Parameterdateien</translation>
    </message>
    <message>
        <source>pose file</source>
        <translation>Posendatei</translation>
    </message>
    <message>
        <source>pose files</source>
        <translation>Posendateien</translation>
    </message>
    <message>
        <source>results</source>
        <translation>Ergebnisse</translation>
    </message>
    <message>
        <source>scribble file</source>
        <translation>Strichdatei</translation>
    </message>
    <message>
        <source>scribble files</source>
        <translation>Strichdateien</translation>
    </message>
    <message>
        <source>segmentations</source>
        <translation>Segmentierungen</translation>
    </message>
    <message>
        <source>disparity as stored in gt_disp_highres.pfm, in the middle of each pixel</source>
        <translation>Disparität wie in gt_disp_highres.pfm gespeichert, in der Mitte jedes Pixels</translation>
    </message>
    <message>
        <source>disparity as stored in gt_disp_lowres.pfm</source>
        <translation>Disparität wie in gt_disp_lowres.pfm gespeichert</translation>
    </message>
    <message>
        <source>disparity as stored in gt_disp_lowres_Cam*.pfm</source>
        <translation>Disparität wie in gt_disp_lowres_Cam*.pfm gespeichert</translation>
    </message>
    <message>
        <source>disparity from gt_depth_lowres.pfm and the camera of parameters.cfg</source>
        <translation>Disparität aus gt_depth_lowres.pfm und der Kamera in parameters.cfg</translation>
    </message>
    <message>
        <source>no truth in this folder</source>
        <translation>keine wahren Werte in diesem Ordner</translation>
    </message>
    <message>
        <source>Range of disparities to search; automatic (auto): from the files, else found from the images; found: from the images, whatever the files say</source>
        <translation>Zu durchsuchender Bereich der Disparitäten; automatisch (auto): aus den Dateien, sonst aus den Bildern gefunden; gefunden (found): aus den Bildern, was auch immer die Dateien sagen</translation>
    </message>
    <message>
        <source>reading ground truth</source>
        <translation>Referenz wird gelesen</translation>
    </message>
    <message>
        <source>image and estimate</source>
        <translation>Bild und Schätzung</translation>
    </message>
    <message>
        <source>image and ground truth</source>
        <translation>Bild und Referenz</translation>
    </message>
    <message>
        <source>Corner views</source>
        <translation>Ansichten der Ecken</translation>
    </message>
    <message>
        <source>For all views: estimate the corners of the grid, too; without, the first view is carried to all others in half the time</source>
        <translation>Für alle Ansichten: auch die Ecken des Rasters schätzen; sonst wird die erste Ansicht in der halben Zeit auf alle anderen übertragen</translation>
    </message>
    <message>
        <source>Own; builds on Kolmogorov 2006 [Kol06] and Bredies et al. 2010 [BKP10]</source>
        <translation>Eigenes Verfahren; baut auf Kolmogorov 2006 [Kol06] und Bredies u. a. 2010 [BKP10] auf</translation>
    </message>
    <message>
        <source>exposing the sensor</source>
        <translation>Sensor wird belichtet</translation>
    </message>
    <message>
        <source>identifying the samples</source>
        <translation>Prüfsumme der Abtastwerte</translation>
    </message>
    <message>
        <source>photographing the center view</source>
        <translation>mittlere Ansicht wird fotografiert</translation>
    </message>
    <message>
        <source>photographs of the built-in gantry</source>
        <translation>Fotos des eingebauten Kameraportals</translation>
    </message>
    <message>
        <source>reading the built-in scene</source>
        <translation>eingebaute Szene wird gelesen</translation>
    </message>
    <message>
        <source>rendering all views</source>
        <translation>alle Ansichten werden gerendert</translation>
    </message>
    <message>
        <source>rendering the center view</source>
        <translation>mittlere Ansicht wird gerendert</translation>
    </message>
    <message>
        <source>writing edges</source>
        <translation>Kanten werden geschrieben</translation>
    </message>
    <message>
        <source>depth map of the center view</source>
        <translation>Tiefenkarte der mittleren Ansicht</translation>
    </message>
    <message>
        <source>depth maps of the center view</source>
        <translation>Tiefenkarten der mittleren Ansicht</translation>
    </message>
    <message>
        <source>disparity map</source>
        <translation>Disparitätskarte</translation>
    </message>
    <message>
        <source>disparity map of the center view</source>
        <translation>Disparitätskarte der mittleren Ansicht</translation>
    </message>
    <message>
        <source>disparity maps</source>
        <translation>Disparitätskarten</translation>
    </message>
    <message>
        <source>disparity maps of the center view</source>
        <translation>Disparitätskarten der mittleren Ansicht</translation>
    </message>
    <message>
        <source>label map</source>
        <translation>Labelkarte</translation>
    </message>
    <message>
        <source>label map of the center view</source>
        <translation>Labelkarte der mittleren Ansicht</translation>
    </message>
    <message>
        <source>label maps</source>
        <translation>Labelkarten</translation>
    </message>
    <message>
        <source>label maps of the center view</source>
        <translation>Labelkarten der mittleren Ansicht</translation>
    </message>
    <message>
        <source>mask of invalid pixels</source>
        <translation>Maske ungültiger Pixel</translation>
    </message>
    <message>
        <source>mask of valid pixels</source>
        <translation>Maske gültiger Pixel</translation>
    </message>
    <message>
        <source>masks of invalid pixels</source>
        <translation>Masken ungültiger Pixel</translation>
    </message>
    <message>
        <source>masks of valid pixels</source>
        <translation>Masken gültiger Pixel</translation>
    </message>
    <message>
        <source>region mask</source>
        <translation>Maske einer Region</translation>
    </message>
    <message>
        <source>region masks</source>
        <translation>Masken von Regionen</translation>
    </message>
    <message>
        <source>result</source>
        <translation>Ergebnis</translation>
    </message>
    <message>
        <source>segmentation</source>
        <translation>Segmentierung</translation>
    </message>
    <message>
        <source>Disparity steps</source>
        <translation>Disparitätsstufen</translation>
    </message>
    <message>
        <source>Jumps by more steps cost no more</source>
        <translation>Sprünge um mehr Stufen kosten nicht mehr</translation>
    </message>
    <message>
        <source>Own; trained on procedural light fields alone</source>
        <translation>Eigenes Verfahren; nur mit prozeduralen Lichtfeldern trainiert</translation>
    </message>
    <message>
        <source>mean of both surfaces</source>
        <translation>Mittel beider Flächen</translation>
    </message>
    <message>
        <source>more probable surface</source>
        <translation>wahrscheinlichere Fläche</translation>
    </message>
    <message>
        <source>steps</source>
        <translation>Stufen</translation>
    </message>
    <message>
        <source>choosing sides</source>
        <translation>Seiten werden gewählt</translation>
    </message>
    <message>
        <source>estimating views</source>
        <translation>Ansichten werden geschätzt</translation>
    </message>
    <message>
        <source>marking invalid pixels</source>
        <translation>ungültige Pixel werden markiert</translation>
    </message>
</context>
<context>
    <name>episcope::ScribbleController</name>
    <message>
        <source>Propagate to all views</source>
        <translation>In alle Ansichten übertragen</translation>
    </message>
    <message>
        <source>Shows the scribbles of every view on all others</source>
        <translation>Zeigt die Striche jeder Ansicht in allen anderen</translation>
    </message>
    <message>
        <source>Propagating scribbles needs a disparity: run a method in the Estimate tab.</source>
        <translation>Striche zu übertragen erfordert eine Disparität: im Reiter Schätzen ein Verfahren ausführen.</translation>
    </message>
    <message>
        <source>propagating …</source>
        <translation>wird übertragen …</translation>
    </message>
</context>
<context>
    <name>episcope::SegmentController</name>
    <message>
        <source>Live</source>
        <translation>Live</translation>
    </message>
    <message>
        <source>Segments the view again after every stroke</source>
        <translation>Segmentiert die Ansicht nach jedem Strich neu</translation>
    </message>
    <message>
        <source>Update now</source>
        <translation>Jetzt aktualisieren</translation>
    </message>
    <message>
        <source>Segments this view from the scribbles</source>
        <translation>Segmentiert diese Ansicht anhand der Striche</translation>
    </message>
    <message>
        <source>Segment all views</source>
        <translation>Alle Ansichten segmentieren</translation>
    </message>
    <message>
        <source>Segments all views, with labels that agree along the rays</source>
        <translation>Segmentiert alle Ansichten mit Labels, die entlang der Strahlen übereinstimmen</translation>
    </message>
    <message>
        <source>Shift+U</source>
        <translation>Shift+U</translation>
    </message>
    <message>
        <source>Writes a black and white PNG of every label in every segmented view to a folder</source>
        <translation>Schreibt für jedes Label in jeder segmentierten Ansicht ein schwarzweißes PNG in einen Ordner</translation>
    </message>
    <message>
        <source>Smoother boundaries</source>
        <translation>Glattere Grenzen</translation>
    </message>
    <message>
        <source>Smooths the boundaries of all labels by half a pixel more; can be undone</source>
        <translation>Glättet die Grenzen aller Labels um ein halbes Pixel mehr; lässt sich zurücknehmen</translation>
    </message>
    <message>
        <source>Shift+S</source>
        <translation>Shift+S</translation>
    </message>
    <message>
        <source>Less smooth boundaries</source>
        <translation>Weniger glatte Grenzen</translation>
    </message>
    <message>
        <source>Smooths the boundaries of all labels by half a pixel less</source>
        <translation>Glättet die Grenzen aller Labels um ein halbes Pixel weniger</translation>
    </message>
    <message>
        <source>probability of “%1”</source>
        <translation>Wahrscheinlichkeit von „%1“</translation>
    </message>
    <message>
        <source>There is no ground-truth disparity for all views: labels are based on the images alone.</source>
        <translation>Es gibt keine Referenz-Disparität für alle Ansichten: die Labels beruhen nur auf den Bildern.</translation>
    </message>
    <message>
        <source>Labels are based on the images alone until the disparity is estimated.</source>
        <translation>Die Labels beruhen nur auf den Bildern, bis die Disparität geschätzt ist.</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>training …</source>
        <translation>wird trainiert …</translation>
    </message>
    <message>
        <source>refining … %1</source>
        <translation>wird verfeinert … %1</translation>
    </message>
    <message>
        <source>waiting</source>
        <translation>wartet</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>fehlgeschlagen</translation>
    </message>
    <message>
        <source>idle</source>
        <translation>bereit</translation>
    </message>
    <message>
        <source>out of date</source>
        <translation>veraltet</translation>
    </message>
    <message>
        <source>idle · %1</source>
        <translation>bereit · %1</translation>
    </message>
    <message>
        <source>State of the segmentation of this view, and how long it took.</source>
        <translation>Stand der Segmentierung dieser Ansicht, und wie lange sie dauerte.</translation>
    </message>
    <message>
        <source>Reading labels</source>
        <translation>Lesen der Labels</translation>
    </message>
    <message>
        <source>labeling …</source>
        <translation>wird gelabelt …</translation>
    </message>
    <message>
        <source>All views are segmented once the disparity is estimated.</source>
        <translation>Alle Ansichten werden segmentiert, sobald die Disparität geschätzt ist.</translation>
    </message>
    <message>
        <source>correcting views: %1 of %2 …</source>
        <translation>Ansichten werden korrigiert: %1 von %2…</translation>
    </message>
    <message>
        <source>waiting for the disparity …</source>
        <translation>wartet auf die Disparität…</translation>
    </message>
    <message>
        <source>before the last stroke</source>
        <translation>vor dem letzten Strich</translation>
    </message>
    <message>
        <source>Other views: before the last stroke.</source>
        <translation>Andere Ansichten: vor dem letzten Strich.</translation>
    </message>
    <message>
        <source>There is no disparity of all views: all views are segmented by the images alone.</source>
        <translation>Es gibt keine Disparität aller Ansichten: Alle Ansichten werden allein nach den Bildern segmentiert.</translation>
    </message>
    <message>
        <source>Masks of labels…</source>
        <translation>Masken der Labels…</translation>
    </message>
    <message>
        <source>%1, out of date</source>
        <translation>%1, veraltet</translation>
    </message>
</context>
<context>
    <name>episcope::SegmentPanel</name>
    <message>
        <source>All views after each stroke</source>
        <translation>Alle Ansichten nach jedem Strich</translation>
    </message>
    <message>
        <source>Settings</source>
        <translation>Einstellungen</translation>
    </message>
    <message>
        <source>Shows the settings of the segmentation</source>
        <translation>Zeigt die Einstellungen der Segmentierung</translation>
    </message>
    <message>
        <source>Disparity</source>
        <translation>Disparität</translation>
    </message>
    <message>
        <source>Smooths the boundaries of all labels; 0 shows them as they were computed. Can be undone</source>
        <translation>Glättet die Grenzen aller Labels; 0 zeigt sie wie berechnet. Lässt sich zurücknehmen</translation>
    </message>
    <message>
        <source> px</source>
        <translation> px</translation>
    </message>
    <message>
        <source>Smooth boundaries by</source>
        <translation>Grenzen glätten um</translation>
    </message>
    <message>
        <source>Strokes change the labels of all views: they are corrected near what the strokes say, or segmented anew if that cannot be</source>
        <translation>Striche ändern die Labels aller Ansichten: Sie werden nahe den Strichen korrigiert oder, wenn das nicht geht, neu segmentiert</translation>
    </message>
    <message>
        <source>Disparity that propagates labels from view to view, and that the classifier may use as a feature</source>
        <translation>Disparität, die Labels von Ansicht zu Ansicht überträgt und die der Klassifikator als Merkmal nutzen kann</translation>
    </message>
</context>
<context>
    <name>episcope::SegmentationExport</name>
    <message>
        <source>Folder for the masks of all views</source>
        <translation>Ordner für die Masken aller Ansichten</translation>
    </message>
    <message>
        <source>Folder for the masks of this view; segment all views first to save all masks</source>
        <translation>Ordner für die Masken dieser Ansicht; für die aller erst alle Ansichten segmentieren</translation>
    </message>
    <message>
        <source>%1 holds labels that were out of date: strokes or settings changed since.</source>
        <translation>%1 enthält veraltete Labels: Striche oder Einstellungen haben sich seither geändert.</translation>
    </message>
</context>
<context>
    <name>episcope::SessionRecovery</name>
    <message>
        <source>Recover</source>
        <translation>Wiederherstellen</translation>
    </message>
    <message>
        <source>Recovered what was open.</source>
        <translation>Das Geöffnete wurde wiederhergestellt.</translation>
    </message>
    <message>
        <source>Discard…</source>
        <translation>Verwerfen…</translation>
    </message>
    <message>
        <source>This deletes the results that the earlier session kept: %1. Its light fields were: %2.</source>
        <translation>Das löscht die Ergebnisse, die die frühere Sitzung behalten hat: %1. Ihre Lichtfelder waren: %2.</translation>
    </message>
    <message>
        <source>light fields: %1</source>
        <translation>Lichtfelder: %1</translation>
    </message>
    <message>
        <source>results: %1</source>
        <translation>Ergebnisse: %1</translation>
    </message>
    <message>
        <source>with scribbles: %1</source>
        <translation>mit Strichen: %1</translation>
    </message>
    <message>
        <source>with labels: %1</source>
        <translation>mit Labels: %1</translation>
    </message>
    <message>
        <source>Episcope ended unexpectedly (%1). What was open can be recovered: %2.</source>
        <translation>Episcope wurde unerwartet beendet (%1). Was offen war, kann wiederhergestellt werden: %2.</translation>
    </message>
</context>
<context>
    <name>episcope::ShortcutWindow</name>
    <message>
        <source>Keys and mouse</source>
        <translation>Tastatur und Maus</translation>
    </message>
    <message>
        <source>Key</source>
        <translation>Taste</translation>
    </message>
    <message>
        <source>What it does</source>
        <translation>Was sie tut</translation>
    </message>
    <message>
        <source>Find a key or a command</source>
        <translation>Taste oder Befehl suchen</translation>
    </message>
    <message>
        <source>Set key</source>
        <translation>Taste setzen</translation>
    </message>
    <message>
        <source>Default</source>
        <translation>Standard</translation>
    </message>
    <message>
        <source>Restores the default keys of the selected command</source>
        <translation>Stellt die Standardtasten des gewählten Befehls wieder her</translation>
    </message>
    <message>
        <source>All defaults</source>
        <translation>Alle auf Standard</translation>
    </message>
    <message>
        <source>Restores the default keys of all commands</source>
        <translation>Stellt die Standardtasten aller Befehle wieder her</translation>
    </message>
    <message>
        <source>In the view</source>
        <translation>In der Ansicht</translation>
    </message>
    <message>
        <source>Click</source>
        <translation>Klick</translation>
    </message>
    <message>
        <source>Moves the cross-hair</source>
        <translation>Versetzt das Fadenkreuz</translation>
    </message>
    <message>
        <source>Shift+click</source>
        <translation>Umschalt+Klick</translation>
    </message>
    <message>
        <source>Focuses on the pixel</source>
        <translation>Fokussiert auf das Pixel</translation>
    </message>
    <message>
        <source>Double click</source>
        <translation>Doppelklick</translation>
    </message>
    <message>
        <source>Drag</source>
        <translation>Ziehen</translation>
    </message>
    <message>
        <source>Moves between the views (parallax); in tiles: pans</source>
        <translation>Wechselt zwischen den Ansichten (Parallaxe); in Kacheln: verschiebt</translation>
    </message>
    <message>
        <source>Middle drag, Space+drag</source>
        <translation>Mittlere Taste, Leertaste+Ziehen</translation>
    </message>
    <message>
        <source>Pans</source>
        <translation>Verschiebt den Ausschnitt</translation>
    </message>
    <message>
        <source>Wheel</source>
        <translation>Mausrad</translation>
    </message>
    <message>
        <source>Zooms at the cursor</source>
        <translation>Zoomt am Mauszeiger</translation>
    </message>
    <message>
        <source>Alt+wheel, Ctrl+wheel</source>
        <translation>Alt+Mausrad, Strg+Mausrad</translation>
    </message>
    <message>
        <source>Moves the focus plane</source>
        <translation>Verschiebt die Fokusebene</translation>
    </message>
    <message>
        <source>Drag in an EPI</source>
        <translation>Ziehen in einem EPI</translation>
    </message>
    <message>
        <source>Draws a line and measures its disparity</source>
        <translation>Zieht eine Linie und misst ihre Disparität</translation>
    </message>
    <message>
        <source>In the view, while annotating</source>
        <translation>In der Ansicht, beim Annotieren</translation>
    </message>
    <message>
        <source>Paints the current label, or uses the current tool</source>
        <translation>Malt das aktuelle Label oder benutzt das aktuelle Werkzeug</translation>
    </message>
    <message>
        <source>Right drag</source>
        <translation>Ziehen mit rechter Taste</translation>
    </message>
    <message>
        <source>Erases</source>
        <translation>Radiert</translation>
    </message>
    <message>
        <source>Shift+drag</source>
        <translation>Umschalt+Ziehen</translation>
    </message>
    <message>
        <source>Paints without changing other labels</source>
        <translation>Malt, ohne andere Labels zu ändern</translation>
    </message>
    <message>
        <source>Ctrl+click</source>
        <translation>Strg+Klick</translation>
    </message>
    <message>
        <source>Ctrl+Shift+wheel</source>
        <translation>Strg+Umschalt+Mausrad</translation>
    </message>
    <message>
        <source>Changes the size of brush or eraser</source>
        <translation>Ändert die Größe von Pinsel oder Radierer</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Cancels the current stroke</source>
        <translation>Bricht den aktuellen Strich ab</translation>
    </message>
    <message>
        <source>Choose a command to change its key.</source>
        <translation>Einen Befehl wählen, um seine Taste zu ändern.</translation>
    </message>
    <message>
        <source>%1: press the new key in the field.</source>
        <translation>%1: die neue Taste im Feld drücken.</translation>
    </message>
    <message>
        <source>%1 already belongs to “%2”, which would lose it.</source>
        <translation>%1 gehört schon zu „%2“, das sie verlieren würde.</translation>
    </message>
    <message>
        <source>Reassign</source>
        <translation>Neu zuweisen</translation>
    </message>
    <message>
        <source>Shows the center view; in tiles: shows that tile alone</source>
        <translation>Zeigt die mittlere Ansicht; in Kacheln: nur diese Kachel</translation>
    </message>
    <message>
        <source>Right click</source>
        <translation>Rechtsklick</translation>
    </message>
    <message>
        <source>Opens a menu for the pixel</source>
        <translation>Öffnet ein Menü zum Pixel</translation>
    </message>
</context>
<context>
    <name>episcope::StartStrip</name>
    <message>
        <source>Try it: &lt;b&gt;1&lt;/b&gt; drag in the view to look around, &lt;b&gt;2&lt;/b&gt; &lt;a href=&quot;tab.estimate&quot;&gt;run a method&lt;/a&gt;, &lt;b&gt;3&lt;/b&gt; &lt;a href=&quot;tab.compare&quot;&gt;compare it with the ground truth&lt;/a&gt;.</source>
        <translation>Ausprobieren: &lt;b&gt;1&lt;/b&gt; in der Ansicht ziehen, um sich umzusehen, &lt;b&gt;2&lt;/b&gt; &lt;a href=&quot;tab.estimate&quot;&gt;ein Verfahren ausführen&lt;/a&gt;, &lt;b&gt;3&lt;/b&gt; &lt;a href=&quot;tab.compare&quot;&gt;mit der Referenz vergleichen&lt;/a&gt;.</translation>
    </message>
    <message>
        <source>This is a demo.</source>
        <translation>Dies ist eine Demo.</translation>
    </message>
    <message>
        <source>Open…</source>
        <translation>Öffnen…</translation>
    </message>
    <message>
        <source>Recent</source>
        <translation>Zuletzt geöffnet</translation>
    </message>
    <message>
        <source>Do not show these hints</source>
        <translation>Diese Hinweise nicht zeigen</translation>
    </message>
</context>
<context>
    <name>episcope::StatisticsController</name>
    <message>
        <source>No map is shown</source>
        <translation>Es wird keine Karte gezeigt</translation>
    </message>
    <message>
        <source>Automatic range</source>
        <translation>Automatischer Bereich</translation>
    </message>
    <message>
        <source>Default range</source>
        <translation>Standardbereich</translation>
    </message>
    <message>
        <source>Restores the default range of the quantity</source>
        <translation>Stellt den Standardbereich der Größe wieder her</translation>
    </message>
    <message>
        <source>Stretches the colors over the visible values</source>
        <translation>Spreizt die Farben über die sichtbaren Werte</translation>
    </message>
    <message>
        <source>Labels have no statistics</source>
        <translation>Labels haben keine Statistik</translation>
    </message>
    <message>
        <source>Wrong labels: %1 % of the visible part</source>
        <translation>Falsche Labels: %1 % des sichtbaren Teils</translation>
    </message>
</context>
<context>
    <name>episcope::StatisticsPanel</name>
    <message>
        <source>min</source>
        <translation>min</translation>
    </message>
    <message>
        <source>median</source>
        <translation>Median</translation>
    </message>
    <message>
        <source>mean</source>
        <translation>Mittel</translation>
    </message>
    <message>
        <source>max</source>
        <translation>max</translation>
    </message>
    <message>
        <source>bad</source>
        <translation>schlecht</translation>
    </message>
    <message>
        <source>invalid</source>
        <translation>ungültig</translation>
    </message>
    <message>
        <source>Visible pixels without a value</source>
        <translation>Sichtbare Pixel ohne Wert</translation>
    </message>
    <message>
        <source>No map is shown</source>
        <translation>Es wird keine Karte gezeigt</translation>
    </message>
    <message>
        <source> px</source>
        <translation> px</translation>
    </message>
    <message>
        <source>Pixels whose error is larger are bad, on the map of bad pixels and here</source>
        <translation>Pixel mit größerem Fehler gelten als schlecht, in der Karte der schlechten Pixel und hier</translation>
    </message>
    <message>
        <source>Bad-pixel threshold</source>
        <translation>Schlecht über</translation>
    </message>
    <message>
        <source>%1 [%2]</source>
        <translation>%1 [%2]</translation>
    </message>
    <message>
        <source>%1 · visible part</source>
        <translation>%1 · sichtbarer Teil</translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation>%1 %</translation>
    </message>
    <message>
        <source>Visible pixels that are off by more than the threshold, without the border of 15 px, which the table ignores, too</source>
        <translation>Sichtbare Pixel, die um mehr als die Schwelle abweichen, ohne den Rand von 15 px, den auch die Tabelle auslässt</translation>
    </message>
    <message>
        <source>bad: of the visible part, without the border of 15 px</source>
        <translation>schlecht: im sichtbaren Teil, ohne den Rand von 15 px</translation>
    </message>
</context>
<context>
    <name>episcope::Step</name>
    <message>
        <source>reading %1</source>
        <translation>%1 wird gelesen</translation>
    </message>
    <message>
        <source>writing %1</source>
        <translation>%1 wird geschrieben</translation>
    </message>
    <message>
        <source>rendering the scene %1</source>
        <translation>Szene %1 wird gerendert</translation>
    </message>
    <message>
        <source>exposing %1</source>
        <translation>%1 wird belichtet</translation>
    </message>
    <message>
        <source>photographing view %1</source>
        <translation>Ansicht %1 wird fotografiert</translation>
    </message>
    <message>
        <source>depth of view %1</source>
        <translation>Tiefe der Ansicht %1</translation>
    </message>
    <message>
        <source>matching view %1</source>
        <translation>Ansicht %1 wird abgeglichen</translation>
    </message>
    <message>
        <source>finding the pattern in %1</source>
        <translation>Muster in %1 wird gesucht</translation>
    </message>
    <message>
        <source>ordering, sweep %1</source>
        <translation>Ordnung, Durchlauf %1</translation>
    </message>
    <message>
        <source>labeling, gap %1</source>
        <translation>Labeling, Lücke %1</translation>
    </message>
</context>
<context>
    <name>episcope::StripController</name>
    <message>
        <source>row %1</source>
        <translation>Zeile %1</translation>
    </message>
    <message>
        <source>column %1</source>
        <translation>Spalte %1</translation>
    </message>
    <message>
        <source>Horizontal EPIs: the views of this row</source>
        <translation>Horizontale EPIs: die Ansichten dieser Zeile</translation>
    </message>
    <message>
        <source>Vertical EPIs: the views of this column</source>
        <translation>Vertikale EPIs: die Ansichten dieser Spalte</translation>
    </message>
    <message>
        <source>Label over the views…</source>
        <translation>Label über die Ansichten…</translation>
    </message>
    <message>
        <source>Shows EPIs through the current label with the boundaries of labels: straight lines where the views agree</source>
        <translation>Zeigt EPIs durch das aktuelle Label mit den Grenzen der Labels: gerade Linien, wo die Ansichten übereinstimmen</translation>
    </message>
    <message>
        <source>Shift+L</source>
        <translation>Shift+L</translation>
    </message>
    <message>
        <source>“%1” over the views</source>
        <translation>„%1“ über die Ansichten</translation>
    </message>
    <message>
        <source>Label over the views</source>
        <translation>Label über die Ansichten</translation>
    </message>
    <message>
        <source>This shows labels of all views: segment all views first (Shift+U).</source>
        <translation>Dies zeigt die Labels aller Ansichten: erst alle Ansichten segmentieren (Umschalt+U).</translation>
    </message>
    <message>
        <source>This view does not show this label.</source>
        <translation>Dieses Label ist in dieser Ansicht nicht zu sehen.</translation>
    </message>
</context>
<context>
    <name>episcope::SweepController</name>
    <message>
        <source>Sweep</source>
        <translation>Variieren</translation>
    </message>
    <message>
        <source>Sweep tab</source>
        <translation>Reiter Variieren</translation>
    </message>
    <message>
        <source>Tries values of one or two parameters of the method</source>
        <translation>Probiert Werte eines oder zweier Parameter des Verfahrens aus</translation>
    </message>
    <message>
        <source>Choose two different parameters.</source>
        <translation>Zwei verschiedene Parameter wählen.</translation>
    </message>
    <message>
        <source>This method has no number that could be varied.</source>
        <translation>Dieses Verfahren hat keine Zahl, die sich variieren ließe.</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1: %2</translation>
    </message>
    <message>
        <source>The first point is being computed.</source>
        <translation>Der erste Punkt wird berechnet.</translation>
    </message>
    <message>
        <source>The points have no such number.</source>
        <translation>Die Punkte haben keine solche Zahl.</translation>
    </message>
    <message>
        <source>Click a point to see its map.</source>
        <translation>Auf einen Punkt klicken, um seine Karte zu sehen.</translation>
    </message>
    <message>
        <source>No ground truth: click a point to see its map.</source>
        <translation>Keine Referenz: auf einen Punkt klicken, um seine Karte zu sehen.</translation>
    </message>
    <message>
        <source>%1 stays in the list of results.</source>
        <translation>%1 bleibt in der Liste der Ergebnisse.</translation>
    </message>
    <message>
        <source>The form of the Estimate tab has the values of this point.</source>
        <translation>Das Formular des Reiters Schätzen hat die Werte dieses Punkts.</translation>
    </message>
    <message>
        <source>Save the sweep</source>
        <translation>Versuchsreihe speichern</translation>
    </message>
    <message>
        <source>CSV (*.csv)</source>
        <translation>CSV (*.csv)</translation>
    </message>
    <message>
        <source>Press Run: a point is plotted here for each value.</source>
        <translation>„Starten“ zeichnet hier zu jedem Wert einen Punkt.</translation>
    </message>
    <message>
        <source>%1 runs on each of %2 center views, the present values first</source>
        <translation>Je %1 Läufe auf %2 mittleren Ansichten, die jetzigen Werte zuerst</translation>
    </message>
    <message>
        <source>%1 runs on the center view, the present values first</source>
        <translation>%1 Läufe auf der mittleren Ansicht, die jetzigen Werte zuerst</translation>
    </message>
    <message>
        <source>Sweep (CSV)…</source>
        <translation>Versuchsreihe (CSV)…</translation>
    </message>
    <message>
        <source>Writes the points of the sweep that is shown in the Sweep tab</source>
        <translation>Schreibt die Punkte der Versuchsreihe, die der Reiter Versuchsreihe zeigt</translation>
    </message>
    <message>
        <source>%1, other values as in Method</source>
        <translation>%1, andere Werte wie unter Verfahren</translation>
    </message>
</context>
<context>
    <name>episcope::SweepPanel</name>
    <message>
        <source>Parameter that is varied</source>
        <translation>Parameter, der variiert wird</translation>
    </message>
    <message>
        <source>Second parameter that is varied</source>
        <translation>Zweiter Parameter, der variiert wird</translation>
    </message>
    <message>
        <source>Run</source>
        <translation>Starten</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Saves the points as CSV</source>
        <translation>Speichert die Punkte als CSV</translation>
    </message>
    <message>
        <source>Upper plot</source>
        <translation>Oberes Diagramm</translation>
    </message>
    <message>
        <source>Lower plot</source>
        <translation>Unteres Diagramm</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>Behalten</translation>
    </message>
    <message>
        <source>Use values</source>
        <translation>Werte übernehmen</translation>
    </message>
    <message>
        <source>Its values</source>
        <translation>Seine Werte</translation>
    </message>
    <message>
        <source>Values such as 0.1, 0.2, 0.4, or first:last:number such as 0.1:1.6:5, spread like the slider of the parameter</source>
        <translation>Werte wie 0.1, 0.2, 0.4 oder erster:letzter:Anzahl wie 0.1:1.6:5, gleichmäßig oder in Potenzen verteilt wie der Regler des Parameters</translation>
    </message>
    <message>
        <source>%1: what it shows</source>
        <translation>%1: was es zeigt</translation>
    </message>
    <message>
        <source>Ends the sweep and keeps its points</source>
        <translation>Beendet die Versuchsreihe; vorhandene Punkte bleiben</translation>
    </message>
    <message>
        <source>Keeps the map of this point in the list of results; otherwise the next point replaces it</source>
        <translation>Behält die Karte dieses Punkts in der Liste der Ergebnisse, wo sonst der nächste Punkt ihren Platz einnimmt</translation>
    </message>
    <message>
        <source>Sets the form of the Estimate tab to the values of this point</source>
        <translation>Übernimmt die Werte dieses Punkts in das Formular des Reiters Schätzen</translation>
    </message>
    <message>
        <source>All open light fields</source>
        <translation>Alle offenen Lichtfelder</translation>
    </message>
    <message>
        <source>Removes this sweep</source>
        <translation>Entfernt diese Versuchsreihe</translation>
    </message>
    <message>
        <source>Runs on every open light field, one after the other</source>
        <translation>Läuft nacheinander auf jedem offenen Lichtfeld</translation>
    </message>
    <message>
        <source>Sweeps</source>
        <translation>Versuchsreihen</translation>
    </message>
    <message>
        <source>Sweeps so far; they are kept in the project</source>
        <translation>Die vorhandenen Versuchsreihen; sie bleiben im Projekt</translation>
    </message>
    <message>
        <source>Light fields that are plotted</source>
        <translation>Gezeichnete Lichtfelder</translation>
    </message>
    <message>
        <source>Which light fields are plotted</source>
        <translation>Welche Lichtfelder gezeichnet werden</translation>
    </message>
    <message>
        <source>Runs the method on the center view with each of the values</source>
        <translation>Führt das Verfahren auf der mittleren Ansicht mit jedem der Werte aus</translation>
    </message>
    <message>
        <source>One only</source>
        <translation>Nur einer</translation>
    </message>
</context>
<context>
    <name>episcope::SweepPlot</name>
    <message>
        <source>MSE×100, all pixels [px²]</source>
        <translation>MSE×100, alle Pixel [px²]</translation>
    </message>
    <message>
        <source>BadPix 0.07, 2016 [%]</source>
        <translation>BadPix 0.07, 2016 [%]</translation>
    </message>
    <message>
        <source>BadPix 0.03, 2016 [%]</source>
        <translation>BadPix 0.03, 2016 [%]</translation>
    </message>
    <message>
        <source>BadPix 0.01, 2016 [%]</source>
        <translation>BadPix 0.01, 2016 [%]</translation>
    </message>
    <message>
        <source>Change of the map [px]</source>
        <translation>Änderung der Karte [px]</translation>
    </message>
    <message>
        <source>Time [s]</source>
        <translation>Zeit [s]</translation>
    </message>
    <message>
        <source>MSE×100 %1</source>
        <translation>MSE×100 %1</translation>
    </message>
    <message>
        <source>BadPix %1 %</source>
        <translation>BadPix %1 %</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>Mean</source>
        <translation>Mittel</translation>
    </message>
    <message>
        <source>Each and the mean</source>
        <translation>Jedes und das Mittel</translation>
    </message>
    <message>
        <source>%1 · %2 light fields</source>
        <translation>%1 · %2 Lichtfelder</translation>
    </message>
    <message>
        <source> (%1 of %2 runs)</source>
        <translation> (%1 von %2 Läufen)</translation>
    </message>
</context>
<context>
    <name>episcope::SweepRuns</name>
    <message>
        <source>Sweep of %1</source>
        <translation>Versuchsreihe mit %1</translation>
    </message>
</context>
<context>
    <name>episcope::Synonyms</name>
    <message>
        <source>load import directory</source>
        <translation>laden importieren Verzeichnis</translation>
    </message>
    <message>
        <source>example sample synthetic</source>
        <translation>Beispiel synthetisch</translation>
    </message>
    <message>
        <source>settings options crop order</source>
        <translation>Einstellungen Optionen zuschneiden Reihenfolge</translation>
    </message>
    <message>
        <source>screenshot image save</source>
        <translation>Bildschirmfoto Bild speichern</translation>
    </message>
    <message>
        <source>image heat map save</source>
        <translation>Bild Falschfarben speichern</translation>
    </message>
    <message>
        <source>video animation save</source>
        <translation>Video Animation speichern</translation>
    </message>
    <message>
        <source>save depth point cloud</source>
        <translation>speichern Tiefe Punktwolke</translation>
    </message>
    <message>
        <source>scores errors spreadsheet save</source>
        <translation>Fehler Tabelle speichern</translation>
    </message>
    <message>
        <source>scores errors paper save</source>
        <translation>Fehler Artikel speichern</translation>
    </message>
    <message>
        <source>zoom percent original</source>
        <translation>Zoom Prozent Original</translation>
    </message>
    <message>
        <source>zoom whole window</source>
        <translation>Zoom ganzes Fenster</translation>
    </message>
    <message>
        <source>contrast dark light levels</source>
        <translation>Kontrast dunkel hell Stufen</translation>
    </message>
    <message>
        <source>parallax animate movie</source>
        <translation>Parallaxe animieren Film</translation>
    </message>
    <message>
        <source>refocus shear slope</source>
        <translation>Schärfe Scherung Steigung</translation>
    </message>
    <message>
        <source>shift sum synthetic aperture</source>
        <translation>verschieben summieren synthetische Apertur</translation>
    </message>
    <message>
        <source>overlay heat map</source>
        <translation>Überlagerung Falschfarben</translation>
    </message>
    <message>
        <source>depth</source>
        <translation>Tiefe</translation>
    </message>
    <message>
        <source>reference depth</source>
        <translation>wahre Tiefe</translation>
    </message>
    <message>
        <source>outliers</source>
        <translation>Ausreißer</translation>
    </message>
    <message>
        <source>split curtain swipe</source>
        <translation>teilen Vorhang wischen</translation>
    </message>
    <message>
        <source>blink toggle</source>
        <translation>blinken wechseln</translation>
    </message>
    <message>
        <source>subtract minus</source>
        <translation>abziehen minus</translation>
    </message>
    <message>
        <source>grid gallery</source>
        <translation>Raster Galerie</translation>
    </message>
    <message>
        <source>paint draw scribble pen</source>
        <translation>malen zeichnen Strich Stift</translation>
    </message>
    <message>
        <source>rubber delete</source>
        <translation>Radierer löschen</translation>
    </message>
    <message>
        <source>night mode</source>
        <translation>Nachtmodus</translation>
    </message>
    <message>
        <source>shortcuts hotkeys bindings</source>
        <translation>Tasten Kürzel Belegung</translation>
    </message>
    <message>
        <source>documentation guide</source>
        <translation>Dokumentation Anleitung</translation>
    </message>
    <message>
        <source>point cloud</source>
        <translation>Punktwolke</translation>
    </message>
    <message>
        <source>mesh save</source>
        <translation>Netz speichern</translation>
    </message>
    <message>
        <source>point cloud mesh depth</source>
        <translation>Punktwolke Netz Tiefe</translation>
    </message>
    <message>
        <source>histogram statistics scores errors</source>
        <translation>Histogramm Statistik Maße Fehler</translation>
    </message>
    <message>
        <source>plot curve distribution histogram</source>
        <translation>Diagramm Kurve Verteilung Histogramm</translation>
    </message>
</context>
<context>
    <name>episcope::TabStack</name>
    <message>
        <source>Detach into a window</source>
        <translation>In ein Fenster lösen</translation>
    </message>
    <message>
        <source>Dock</source>
        <translation>Andocken</translation>
    </message>
</context>
<context>
    <name>episcope::Theme</name>
    <message>
        <source>Follow the desktop</source>
        <translation>Wie die Arbeitsumgebung</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Hell</translation>
    </message>
    <message>
        <source>Dark text on a light background</source>
        <translation>Dunkler Text auf hellem Grund</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>Dunkel</translation>
    </message>
    <message>
        <source>Light text on a dark background</source>
        <translation>Heller Text auf dunklem Grund</translation>
    </message>
    <message>
        <source>Colors of the desktop</source>
        <translation>Farben der Arbeitsumgebung</translation>
    </message>
</context>
<context>
    <name>episcope::TimeBar</name>
    <message>
        <source>Frame</source>
        <translation>Einzelbild</translation>
    </message>
    <message>
        <source>Frame of the sequence</source>
        <translation>Einzelbild der Sequenz</translation>
    </message>
    <message>
        <source>frame %1 of 0…%2</source>
        <translation>Einzelbild %1 von 0…%2</translation>
    </message>
</context>
<context>
    <name>episcope::ToneController</name>
    <message>
        <source>Brightness</source>
        <translation>Helligkeit</translation>
    </message>
    <message>
        <source>Brightness…</source>
        <translation>Helligkeit…</translation>
    </message>
    <message>
        <source>Exposure, gamma and black point of the views, for display only</source>
        <translation>Belichtung, Gamma und Schwarzpunkt der Ansichten, nur für die Anzeige</translation>
    </message>
    <message>
        <source>Shift+B</source>
        <translation>Shift+B</translation>
    </message>
    <message>
        <source>Automatic brightness</source>
        <translation>Automatische Helligkeit</translation>
    </message>
    <message>
        <source>Brightens dark views, or shows them unchanged</source>
        <translation>Hellt dunkle Ansichten auf; noch einmal zeigt sie unverändert</translation>
    </message>
    <message>
        <source>Shift+A</source>
        <translation>Shift+A</translation>
    </message>
    <message>
        <source>The views are dark.</source>
        <translation>Die Ansichten sind dunkel.</translation>
    </message>
    <message>
        <source>Brighten</source>
        <translation>Aufhellen</translation>
    </message>
</context>
<context>
    <name>episcope::TonePanel</name>
    <message>
        <source>Exposure</source>
        <translation>Belichtung</translation>
    </message>
    <message>
        <source>Each stop doubles the brightness</source>
        <translation>Jede Blende verdoppelt die Helligkeit</translation>
    </message>
    <message>
        <source> stops</source>
        <translation> Blenden</translation>
    </message>
    <message>
        <source>Gamma</source>
        <translation>Gamma</translation>
    </message>
    <message>
        <source>More than 1 lifts the shadows</source>
        <translation>Mehr als 1 hellt die Schatten auf</translation>
    </message>
    <message>
        <source>Black point</source>
        <translation>Schwarzpunkt</translation>
    </message>
    <message>
        <source>Darker values are shown as black; 1 is white</source>
        <translation>Was dunkler ist, wird schwarz gezeigt; 1 ist Weiß</translation>
    </message>
    <message>
        <source>Automatic</source>
        <translation>Automatisch</translation>
    </message>
    <message>
        <source>Shows the whole brightness range of this view</source>
        <translation>Zeigt den ganzen Helligkeitsumfang dieser Ansicht</translation>
    </message>
    <message>
        <source>Reset</source>
        <translation>Zurücksetzen</translation>
    </message>
    <message>
        <source>Shows samples as they are</source>
        <translation>Zeigt die Samples unverändert</translation>
    </message>
    <message>
        <source>Brightens views, EPIs, tiles, the points of the 3D tab, and saved pictures and movies. Results, labels, PLY files and converted light fields keep the samples.</source>
        <translation>Hellt auf, was gezeigt wird: Ansichten, EPIs, Kacheln, die Punkte des Reiters 3D sowie Bilder und Filme, die wie gezeigt gespeichert werden. Ergebnisse, Labels, PLY-Dateien und umgewandelte Lichtfelder behalten die Samples.</translation>
    </message>
</context>
<context>
    <name>episcope::ValueBar</name>
    <message>
        <source>%1 invalid</source>
        <translation>%1 ungültig</translation>
    </message>
    <message>
        <source>, behind %1</source>
        <translation>, dahinter %1</translation>
    </message>
    <message>
        <source>x %1 y %2</source>
        <translation>x %1 y %2</translation>
    </message>
    <message>
        <source>rgb %1</source>
        <translation>rgb %1</translation>
    </message>
    <message>
        <source>grey %1</source>
        <translation>grau %1</translation>
    </message>
    <message>
        <source>ground truth %1</source>
        <translation>Referenz %1</translation>
    </message>
    <message>
        <source>no ground truth here</source>
        <translation>hier keine Referenz</translation>
    </message>
    <message>
        <source>Move over the view to read its values</source>
        <translation>Die Maus über die Ansicht bewegen, um ihre Werte zu lesen</translation>
    </message>
</context>
<context>
    <name>episcope::ValueController</name>
    <message>
        <source>ready</source>
        <translation>bereit</translation>
    </message>
    <message>
        <source>1 job running</source>
        <translation>1 Auftrag läuft</translation>
    </message>
    <message>
        <source>%1 jobs running</source>
        <translation>%1 Aufträge laufen</translation>
    </message>
    <message>
        <source>label %1</source>
        <translation>Label %1</translation>
    </message>
    <message>
        <source>painted %1</source>
        <translation>gemalt %1</translation>
    </message>
    <message>
        <source>segment %1</source>
        <translation>Segment %1</translation>
    </message>
    <message>
        <source>true label %1</source>
        <translation>wahres Label %1</translation>
    </message>
</context>
<context>
    <name>episcope::ViewCanvas</name>
    <message>
        <source>View</source>
        <translation>Ansicht</translation>
    </message>
    <message>
        <source>Open a light field to see it here.</source>
        <translation>Ein Lichtfeld öffnen, um es hier zu sehen.</translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation>%1 %</translation>
    </message>
    <message>
        <source>No light field</source>
        <translation>Kein Lichtfeld</translation>
    </message>
    <message>
        <source>Loading</source>
        <translation>Wird geladen</translation>
    </message>
    <message>
        <source>Could not show this</source>
        <translation>Das ließ sich nicht anzeigen</translation>
    </message>
</context>
<context>
    <name>episcope::ViewGrid</name>
    <message>
        <source>Plays the views one after the other</source>
        <translation>Spielt die Ansichten nacheinander ab</translation>
    </message>
    <message>
        <source>circle</source>
        <translation>Kreis</translation>
    </message>
    <message>
        <source>swing</source>
        <translation>Schwenk</translation>
    </message>
    <message>
        <source>snake</source>
        <translation>Schlange</translation>
    </message>
    <message>
        <source>Order in which the views are played</source>
        <translation>Reihenfolge, in der die Ansichten abgespielt werden</translation>
    </message>
    <message>
        <source>v %1  u %2</source>
        <translation>v %1  u %2</translation>
    </message>
</context>
<context>
    <name>episcope::ViewGridCells</name>
    <message>
        <source>Views</source>
        <translation>Ansichten</translation>
    </message>
    <message>
        <source>view v %1, u %2</source>
        <translation>Ansicht v %1, u %2</translation>
    </message>
    <message>
        <source>%1: painted</source>
        <translation>%1: bemalt</translation>
    </message>
    <message>
        <source>No views</source>
        <translation>Keine Ansichten</translation>
    </message>
    <message>
        <source>Opening …</source>
        <translation>Wird geöffnet …</translation>
    </message>
</context>
<context>
    <name>episcope::ViewerArea</name>
    <message>
        <source>Open a light field first.</source>
        <translation>Erst ein Lichtfeld öffnen.</translation>
    </message>
    <message>
        <source>The light field is still loading.</source>
        <translation>Das Lichtfeld wird noch geladen.</translation>
    </message>
</context>
<context>
    <name>episcope::render</name>
    <message>
        <source>Background</source>
        <translation>Hinten</translation>
    </message>
    <message>
        <source>Confidence</source>
        <translation>Konfidenz</translation>
    </message>
    <message>
        <source>Difference</source>
        <translation>Differenz</translation>
    </message>
    <message>
        <source>Disparity</source>
        <translation>Disparität</translation>
    </message>
    <message>
        <source>Edges</source>
        <translation>Kanten</translation>
    </message>
    <message>
        <source>Error</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>Labels</source>
        <translation>Labels</translation>
    </message>
    <message>
        <source>Layers</source>
        <translation>Schichten</translation>
    </message>
    <message>
        <source>None</source>
        <translation>Keine</translation>
    </message>
    <message>
        <source>Probability</source>
        <translation>Gewissheit</translation>
    </message>
    <message>
        <source>Segments</source>
        <translation>Segmente</translation>
    </message>
    <message>
        <source>Shows how uncertain the labels are</source>
        <translation>Zeigt, wie unsicher die Labels sind</translation>
    </message>
    <message>
        <source>Shows the confidence of the method, from 0 to 1</source>
        <translation>Zeigt die Konfidenz des Verfahrens, von 0 bis 1</translation>
    </message>
    <message>
        <source>Shows the current result minus the compared one</source>
        <translation>Zeigt das aktuelle Ergebnis minus das Vergleichsergebnis</translation>
    </message>
    <message>
        <source>Shows the disparity of the background seen through a surface</source>
        <translation>Zeigt die Disparität des Hintergrunds, den man durch eine Fläche hindurch sieht</translation>
    </message>
    <message>
        <source>Shows the disparity of the result over the view</source>
        <translation>Zeigt die Disparität des Ergebnisses über der Ansicht</translation>
    </message>
    <message>
        <source>Shows the magnitude of the error</source>
        <translation>Zeigt den Betrag des Fehlers</translation>
    </message>
    <message>
        <source>Shows the pixels that are off by more than the threshold, 0.07 px at first</source>
        <translation>Zeigt die Pixel, deren Fehler über der Schwelle liegt, anfangs 0.07 px</translation>
    </message>
    <message>
        <source>Shows the pixels whose label is not the true one</source>
        <translation>Zeigt die Pixel, deren Label nicht das wahre ist</translation>
    </message>
    <message>
        <source>Shows the probability of the current label</source>
        <translation>Zeigt die Wahrscheinlichkeit des aktuellen Labels</translation>
    </message>
    <message>
        <source>Shows the segmentation over the view, or hides it</source>
        <translation>Zeigt die Segmentierung über der Ansicht oder blendet sie aus</translation>
    </message>
    <message>
        <source>Shows the true disparity</source>
        <translation>Zeigt die wahre Disparität</translation>
    </message>
    <message>
        <source>Shows the true disparity of the background seen through a surface</source>
        <translation>Zeigt die wahre Disparität des Hintergrunds, den man durch die Fläche hindurch sieht</translation>
    </message>
    <message>
        <source>Shows the true object labels</source>
        <translation>Zeigt die wahren Labels der Objekte</translation>
    </message>
    <message>
        <source>Shows the view alone</source>
        <translation>Zeigt nur die Ansicht</translation>
    </message>
    <message>
        <source>Shows truth − estimate: blue is too near, red too far</source>
        <translation>Zeigt Referenz − Schätzung: Blau ist zu nah, Rot zu fern</translation>
    </message>
    <message>
        <source>Shows where label boundaries are cheap</source>
        <translation>Zeigt, wo Grenzen zwischen Labels wenig kosten</translation>
    </message>
    <message>
        <source>Shows where one surface is visible and where two are</source>
        <translation>Zeigt, wo eine Fläche sichtbar ist und wo zwei</translation>
    </message>
    <message>
        <source>Uncertainty</source>
        <translation>Unsicherheit</translation>
    </message>
    <message>
        <source>Wrong</source>
        <translation>Falsch</translation>
    </message>
    <message>
        <source>absolute error</source>
        <translation>absoluter Fehler</translation>
    </message>
    <message>
        <source>background</source>
        <translation>Hintergrund</translation>
    </message>
    <message>
        <source>bad pixels</source>
        <translation>schlechte Pixel</translation>
    </message>
    <message>
        <source>confidence</source>
        <translation>Konfidenz</translation>
    </message>
    <message>
        <source>difference</source>
        <translation>Differenz</translation>
    </message>
    <message>
        <source>disparity</source>
        <translation>Disparität</translation>
    </message>
    <message>
        <source>edge probability</source>
        <translation>Kantenwahrscheinlichkeit</translation>
    </message>
    <message>
        <source>labels</source>
        <translation>Labels</translation>
    </message>
    <message>
        <source>layers</source>
        <translation>Schichten</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>probability</source>
        <translation>Wahrscheinlichkeit</translation>
    </message>
    <message>
        <source>px</source>
        <translation>px</translation>
    </message>
    <message>
        <source>segmentation</source>
        <translation>Segmentierung</translation>
    </message>
    <message>
        <source>signed error</source>
        <translation>Fehler mit Vorzeichen</translation>
    </message>
    <message>
        <source>true background</source>
        <translation>wahrer Hintergrund</translation>
    </message>
    <message>
        <source>uncertainty</source>
        <translation>Unsicherheit</translation>
    </message>
    <message>
        <source>wrong labels</source>
        <translation>falsche Labels</translation>
    </message>
    <message>
        <source>|Error|</source>
        <translation>|Fehler|</translation>
    </message>
    <message>
        <source>Second</source>
        <translation>Zweite</translation>
    </message>
    <message>
        <source>Shows another disparity that pixels beside silhouettes may have</source>
        <translation>Zeigt eine andere Disparität, die Pixel an Silhouetten haben können</translation>
    </message>
    <message>
        <source>second disparity</source>
        <translation>zweite Disparität</translation>
    </message>
    <message>
        <source>Ground truth</source>
        <translation>Referenz</translation>
    </message>
    <message>
        <source>ground truth</source>
        <translation>Referenz</translation>
    </message>
    <message>
        <source>True background</source>
        <translation>Wahrer Hintergrund</translation>
    </message>
    <message>
        <source>Bad pixels</source>
        <translation>Schlechte Pixel</translation>
    </message>
</context>
</TS>
