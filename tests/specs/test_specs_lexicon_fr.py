"""French wordings of makers' sheets, by type and name: what each is taken for; a value in front of a colon after a
minus is of something that no name asks for."""

from __future__ import annotations

import pytest
from specs_lexicon import misread

LABELS = """\
@wheel_loader
Lift Cylinder Stroke: Course des vérins de levage
Tilt Cylinder Stroke: Course du vérin de basculement
Steering Cylinder Stroke: Course des vérins de direction
Lift Cylinder Bore: Diamètre de piston vérin de levage
Tilt Cylinder Bore: Alésage du vérin de basculement
Steering Cylinder Bore: Diamètre des vérins de direction
Lift Cylinder Rod Diameter: Diamètre de la tige des vérins de levage
Steering Cylinder Rod Diameter: Diamètre de tige vérins de direction
Main Relief Pressure: Pression d'ouverture du clapet de décharge
Steering Relief Pressure: Pression de service de la direction
Main Pump Flow: Débit de la pompe d'équipement
Steering Pump Flow: Débit de la pompe de direction
Raise Time: Temps de levée du godet chargé
Dump Time: Temps de vidage (en charge)
Lower Time: Descente en position flottante
Total Cycle Time: Temps de cycle hydraulique total
Operating Weight: Poids opérationnel avec godet
Bucket Weight: Poids du godet standard
Counterweight Weight: Poids du contrepoids
Static Tipping Load Straight: Charge de basculement statique en position droite
Static Tipping Load Full Turn: Charge de basculement statique, châssis articulé à 40°
Breakout Force: Force d'arrachement hydraulique
Rimpull: Effort de traction à la jante
Maximum Travel Speed: Vitesse maximale en marche avant
Maximum Steering Angle: Angle maximum d'articulation
Steering Angle: Angle d'articulation gauche/droite
Rear Axle Oscillation: Oscillation totale de l'essieu arrière
Rear Axle Oscillation Each Way: Oscillation du pont arrière de chaque côté
Wheelbase: Distance entre les essieux
Tread: Voie (entre axes des pneus)
Hinge Pin Height at Maximum Lift: Hauteur de l'axe d'articulation du godet à levage maxi
Hinge Pin Height at Carry: Hauteur de l'axe du godet en position de transport
Rack Back at Ground: Angle de redressement du godet au sol
Rack Back at Carry: Angle de redressement en position de portage
Rack Back at Maximum Lift: Angle de cavage à hauteur de levage maximale
Dump Angle at Maximum Lift: Angle de déversement à hauteur de levage maximale
Dumping Clearance: Hauteur de déchargement à hauteur max. et 45°
Dumping Reach: Portée maximale à hauteur de déversement maxi
Lift Arm Clearance at Maximum Lift: Dégagement sous les bras au levage maximal
Digging Depth: Profondeur de fouille (godet horizontal)
Overall Length: Longueur hors tout avec godet standard au sol
Overall Length Without Bucket: Longueur hors tout sans accessoire
Overall Height: Hauteur au sommet de la cabine ROPS/FOPS
Overall Operating Height: Hauteur hors tout à levage maximal
Overall Width: Largeur de la machine aux pneus
Bucket Width: Largeur extérieure du godet
Ground Clearance: Garde au sol à l'articulation
Hitch Height: Hauteur de la barre d'attelage
Height to Top of Stack: Hauteur au sommet du tuyau d'échappement
Axle Height: Hauteur au centre de l'essieu
Rear Overhang: Axe de l'essieu arrière au bord du contrepoids
Rear Axle to Hitch: Distance essieu arrière - articulation centrale
Turning Radius: Rayon de braquage à l'extérieur des pneus
Bucket Capacity Heaped: Capacité du godet avec dôme
Bucket Capacity Struck: Capacité du godet arasée
Tyre Diameter: Diamètre extérieur des pneus
Net Power: Puissance moteur nette à 1800 tr/min
Gross Power: Puissance moteur (ISO 14396)
Engine Power: Puissance moteur à 2200 tr/min
-110 mm: Alésage [Moteur]; Alésage x course moteur; Alésage moteur; Diamètre de piston moteur
-130 mm: Course [Moteur]; Course moteur; Course du piston moteur
-0.3 m³: Réservoir de carburant; Capacité du réservoir; Réservoir hydraulique; Capacité du réservoir à carburant
-20 MPa: Pression de freinage; Pression de pilotage; Pression du ventilateur; Pression d'injection
-400 kPa: Pression de gonflage des pneus; Pression des pneus; Pression au sol
-120 L/min: Débit auxiliaire; Débit pompe de freinage; Débit du ventilateur; Débit de la pompe à carburant
-3500 kg: Charge utile; Charge utile avec fourches; Charge nominale fourches; Capacité de levage
-7000 kg: Poids sur essieu avant; Poids sur essieu arrière; Poids de transport; Poids sans godet
-900 kg: Poids des fourches; Variation de charge de basculement; Poids des pneus; Lestage des pneus
-120 kN: Force de levage; Capacité de levage au sol; Force de freinage; Force de levage au sol
-20 km/h: 2e vitesse; Vitesse en marche arrière; 3e rapport; Vitesse 1ère
-30 °: Pente admissible; Angle de fuite; Angle d'attaque; Angle de départ
-2500 mm: Largeur aux ailes; Largeur de la cabine; Largeur hors rétroviseurs; Largeur des fourches
-3300 mm: Hauteur du capot; Hauteur du gyrophare; Hauteur de levage des fourches; Hauteur maxi des fourches
-1200 mm: Portée au sol; Portée des fourches; Portée fourches au niveau du sol; Hauteur du godet
-6000 mm: Rayon de braquage intérieur; Rayon de braquage au godet; Rayon de braquage hors godet
-80 kW: Puissance du démarreur; Alternateur; Puissance de l'alternateur; Prise de force
@excavator
Boom Cylinder Stroke: Course du vérin de levage de flèche
Boom Cylinder Bore: Alésage des vérins de flèche
Boom Cylinder Rod Diameter: Diamètre de tige vérin de flèche
Arm Cylinder Stroke: Vérin de balancier, course
Arm Cylinder Bore: Vérin de balancier, alésage
Bucket Cylinder Stroke: Course du vérin de godet
Bucket Cylinder Bore: Vérin de godet, alésage
Adjust Cylinder Stroke: Vérin de flèche articulée course
Blade Cylinder Stroke: Vérins de lame stabilisatrice course
Main Relief Pressure: Pression de tarage des soupapes principales
Swing Relief Pressure: Pression de service orientation
Travel Relief Pressure: Pression circuit de translation
Main Pump Flow: Débit max. des pompes principales
Swing Speed: Vitesse d'orientation de la tourelle
Swing Torque: Couple de rotation de la tourelle
Maximum Travel Speed: Vitesse de translation, grande vitesse
Travel Speed Low: Vitesse de translation, petite vitesse
Drawbar Pull: Effort de traction à la barre
Operating Weight: Poids opérationnel avec tuiles de 600 mm
Counterweight: Poids du contrepoids
Bucket Capacity: Capacité du godet ISO 7451
Bucket Width: Largeur du godet avec dents latérales
Bucket Tip Radius: Rayon de la pointe du godet
Boom Length: Longueur de la flèche standard
Arm Length: Longueur du balancier standard
Maximum Digging Depth: Profondeur maximale de creusage
Maximum Digging Depth 2.44 m Level Bottom: Profondeur maximale d'excavation pour un fond plat de 2440 mm
Maximum Vertical Wall Digging Depth: Profondeur de creusement max. en paroi verticale
Maximum Digging Height: Hauteur maximale de creusement
Maximum Dumping Height: Hauteur maximale de déversement
Minimum Dumping Height: Hauteur minimale de déversement
Maximum Reach: Portée maximale de fouille
Maximum Reach at Ground Line: Portée maxi de fouille au niveau du sol
Minimum Swing Radius: Rayon de giration avant minimum
Tail Swing Radius: Rayon d'orientation arrière de la tourelle
Overall Length: Longueur hors tout en position de transport
Overall Width: Largeur hors tout du train de chenilles
Overall Height: Hauteur hors tout jusqu'au sommet de la flèche
Cab Height: Hauteur hors tout jusqu'au sommet de la cabine
Height to Handrail: Hauteur au sommet du garde-corps
Upperstructure Width: Largeur de la structure supérieure
Track Length: Longueur hors tout du train de chenilles
Track Length on Ground: Distance entraxe barbotin / roue folle
Track Gauge: Voie du train de chenilles
Shoe Width: Largeur des tuiles à trois arêtes
Track Height: Hauteur du train de chenilles
Ground Clearance: Garde au sol du châssis inférieur
Counterweight Clearance: Dégagement au sol du contrepoids
Bucket Digging Force: Force d'excavation au vérin de godet
Arm Digging Force: Effort de pénétration du balancier
Track Shoes Each Side: Nombre de patins de chaque côté
Track Rollers Each Side: Nombre de galets de roulement de chaque côté
Carrier Rollers Each Side: Nombre de galets supérieurs par côté
Blade Width: Largeur de la lame de nivellement
Blade Height: Hauteur de lame de remblayage
Blade Lift Height: Levage de lame au-dessus du sol
Blade Digging Depth: Profondeur de lame sous le niveau du sol
Boom Swing Angle Left: Angle d'orientation de la flèche à gauche
Boom Swing Angle Right: Angle d'orientation de la flèche à droite
Ground Pressure: Pression au sol (chenilles caoutchouc)
Net Power: Puissance nette au volant
Gross Power: Puissance moteur (ISO 14396)
Engine Power: Puissance moteur à 1800 tr/min
-110 mm: Alésage [Moteur]; Course [Moteur]; Pas des tuiles; Hauteur des arêtes
-120 kN: Capacité de levage; Force de levage; Force de freinage; Force d'arrachement avec Power Boost
-0.3 m³: Réservoir de carburant; Réservoir hydraulique; Capacité du réservoir à carburant; Circuit hydraulique
-25 MPa: Pression de pilotage; Pression circuit pilote; Circuit de pilotage; Pression auxiliaire
-100 L/min: Débit auxiliaire; Pompe de pilotage; Débit pompe de pilotage; Débit circuit auxiliaire
-1800 rpm: Régime moteur; Régime nominal
-0.6 kNm: Couple moteur; Couple maximal du moteur
-3500 kg: Poids de transport; Capacité de levage; Poids de la flèche; Poids du châssis
-3000 mm: Hauteur du capot; Largeur cabine; Hauteur au capot moteur; Largeur de transport du contrepoids
-1000 mm: Déport latéral; Déport de flèche; Hauteur du marchepied; Hauteur du godet
-8000 mm: Hauteur au crochet; Portée au crochet; Profondeur avec benne preneuse; Hauteur de fouille benne preneuse
-35 °: Pente franchissable; Angle d'ouverture du godet; Angle de pente; Rotation du godet
-60 kW: Démarreur; Alternateur; Puissance du démarreur; Climatisation
-3 km/h: Vitesse moyenne de translation; Vitesse de translation moyenne; Vitesse de levage
@backhoe_loader
Loader Lift Cylinder Stroke: Vérins de levage chargeur, course
Loader Bucket Cylinder Stroke: Course du vérin de cavage chargeur
Boom Cylinder Stroke: Vérin de flèche, course
Dipper Cylinder Stroke: Vérin de balancier, course
Backhoe Bucket Cylinder Stroke: Vérin de godet rétro, course
Swing Cylinder Stroke: Course du vérin de pivotement
Swing Cylinder Bore: Vérins d'orientation, alésage
Operating Weight: Poids total en ordre de marche
Main Relief Pressure: Pression du circuit hydraulique
Main Pump Flow: Débit pompe à 2200 tr/min
Maximum Travel Speed: Vitesse maximale sur route
Overall Length: Longueur hors tout en position route
Overall Width: Largeur hors tout sans godet
Wheelbase: Distance entre essieux
Ground Clearance: Garde au sol minimale
Turning Radius: Rayon de braquage extérieur aux pneus
Loader Hinge Pin Height: Hauteur maxi à l'axe d'articulation du godet
Loader Dump Height: Hauteur de déversement du chargeur
Loader Dump Reach: Portée de déversement à hauteur max.
Loader Dump Angle: Angle de déversement à hauteur maximale
Loader Rollback Angle: Angle de redressement au sol
Loader Digging Depth: Profondeur de fouille du godet chargeur
Loader Breakout Force: Force d'arrachement du godet chargeur
Loader Bucket Width: Largeur hors tout avec godet
Loader Bucket Capacity: Capacité du godet chargeur à refus
Loader Raise Time: Temps de levage
Loader Lower Time: Temps d'abaissement
Loader Dump Time: Temps de déversement
Loader Lift Arm Breakout Force: Force d'arrachement aux bras de levage
Loader Lift Capacity: Capacité de levage chargeur à pleine hauteur
Maximum Digging Depth: Profondeur de fouille maximale SAE
Maximum Reach at Ground Line: Portée au sol à partir de l'axe de rotation
Backhoe Loading Height: Hauteur de chargement de la rétro
Backhoe Operating Height: Hauteur de fonctionnement maximale
Backhoe Swing Arc: Angle d'orientation de la flèche
Backhoe Bucket Rotation: Débattement angulaire du godet
Bucket Digging Force: Force d'excavation godet rétro
Dipper Digging Force: Force de pénétration au balancier
Swing Pivot to Rear Axle: Entre l'axe de l'essieu arrière et l'axe d'orientation
Kingpost Clearance: Garde au sol du support de flèche
Stabilizer Spread: Largeur stabilisateurs en position de travail
Backhoe Bucket Capacity: Capacité du godet excavateur
Steering Angle: Angle de braquage des roues avant
Front Axle Oscillation: Angle d'oscillation de l'essieu avant
Engine Power: Puissance nominale
Net Power: Puissance nette ISO 9249
Gross Power: Puissance brute SAE J1995
-110 mm: Alésage [Moteur]; Course [Moteur]; Course moteur
-0.15 m³: Réservoir de carburant; Réservoir hydraulique; Circuit hydraulique
-21 MPa: Pression de freinage; Pression de direction; Pression auxiliaire; Pression circuit marteau
-90 L/min: Débit auxiliaire; Débit marteau; Débit direction; Débit circuit auxiliaire
-12 km/h: 2e vitesse; 1re vitesse; Vitesse en 2e; Marche arrière
-3500 kg: Charge sur essieu avant; Charge essieu arrière; Capacité de levage au balancier; Poids du godet rétro
-2200 mm: Largeur du godet rétro; Largeur de voie avant; Largeur aux rétroviseurs; Largeur stabilisateurs repliés
-4500 mm: Profondeur de fouille balancier télescopique sorti; Portée de chargement; Diamètre de braquage
-350 mm: Garde au sol sous stabilisateurs; Garde au sol stabilisateurs
-50 kN: Effort de traction; Force de levage; Effort de traction maxi
-45 °: Angle de départ; Angle de fuite; Pente franchissable; Angle d'attaque
-5 kW: Alternateur; Démarreur
@skid_steer
Lift Cylinder Stroke: Course des vérins de levage
Tilt Cylinder Stroke: Course vérins de basculement
Operating Weight: Poids en ordre de marche
Main Relief Pressure: Pression du circuit hydraulique
Main Pump Flow: Débit de la pompe hydraulique
Maximum Travel Speed: Vitesse de déplacement (gamme haute)
Overall Height: Hauteur avec cabine de l'opérateur
Overall Width: Largeur hors tout sans godet
Wheelbase: Entraxe des essieux
Ground Clearance: Garde au sol minimale
Hinge Pin Height at Maximum Lift: Hauteur jusqu'à l'axe d'articulation du godet
Dumping Clearance: Hauteur de déversement godet standard
Dumping Reach: Portée de déversement à hauteur maximale
Dump Angle at Maximum Lift: Angle de déversement à hauteur maximale
Rack Back at Ground: Angle de cavage du godet au sol
Digging Depth: Profondeur de fouille maxi
Breakout Force: Force d'arrachement vérin de basculement
Bucket Width: Largeur hors tout avec godet
Bucket Capacity: Capacité nominale du godet
Raise Time: Relevage des bras de levage
Lower Time: Abaissement des bras de levage
Dump Time: Temps de déversement
Rated Operating Capacity: Capacité nominale (50 % de la charge de basculement)
Tipping Load: Charge de basculement ISO 14397-1
Length with Bucket: Longueur hors tout godet au sol
Length Without Attachment: Longueur de la machine sans accessoire
Turning Radius with Bucket: Rayon de braquage avec godet standard
Turning Radius Rear: Rayon de dégagement arrière
Departure Angle: Angle de dégagement arrière
Operating Height Fully Raised: Hauteur hors tout en position levée
Lift Arm Breakout Force: Force d'arrachement au vérin de levage
Auxiliary Flow: Débit hydraulique auxiliaire
Engine Power: Puissance maximale
-100 mm: Alésage [Moteur]; Course [Moteur]
-0.09 m³: Réservoir de carburant; Réservoir hydraulique
-120 L/min: Haut débit; Débit auxiliaire haut débit; Débit élevé; Grand débit
-1500 kg: Poids d'expédition; Charge aux fourches; Poids du godet; Contrepoids
-1500 mm: Voie; Longueur des fourches; Hauteur du siège; Largeur de cabine
-25 °: Angle d'attaque; Pente admissible; Angle de cavage à hauteur maximale; Angle d'approche
-20 kN: Effort de traction; Force de traction; Force de poussée
-8 km/h: Vitesse en marche arrière; Vitesse petite; Vitesse de déplacement lente
@dozer
Blade Lift Cylinder Stroke: Course des vérins de levage de la lame
Blade Tilt Cylinder Stroke: Vérin d'inclinaison de lame, course
Ripper Lift Cylinder Stroke: Vérin de levage du ripper, course
Main Relief Pressure: Pression du circuit d'équipement
Main Pump Flow: Débit pompe équipement
Operating Weight: Poids en ordre de marche avec lame
Maximum Travel Speed: Vitesse maximale en marche avant
Maximum Reverse Speed: Vitesse de déplacement en marche arrière
Shipping Weight: Poids d'expédition sans lame
Blade Weight: Poids équipement lame
Blade Capacity: Capacité de la lame SAE J1265
Blade Width: Largeur de la lame (aux couteaux d'angle)
Blade Height: Hauteur de la lame bulldozer
Blade Digging Depth: Profondeur de pénétration de la lame
Blade Lift Height: Levage maximal au-dessus du sol
Maximum Blade Tilt: Inclinaison maxi de la lame
Blade Tilt Angle: Angle d'inclinaison transversale
Blade Pitch Adjustment: Réglage de l'angle d'attaque de la lame
Blade Angle: Angle d'orientation de chaque côté
Length Without Blade: Longueur de la machine de base
Length with Blade: Longueur hors tout avec lame droite
Width over Trunnions: Largeur hors tout aux tourillons
Overall Height: Hauteur au sommet de la cabine
Ground Clearance: Garde au sol minimale
Track Gauge: Écartement des chenilles
Shoe Width: Largeur des patins à simple arête
Width over Tracks: Largeur du tracteur aux chenilles
Track Length on Ground: Longueur de chenille en contact avec le sol
Track Pitch: Pas des chenilles
Grouser Height: Hauteur des barrettes
Track Shoes Each Side: Nombre de patins de chaque côté
Track Rollers Each Side: Nombre de galets inférieurs par côté
Carrier Rollers Each Side: Galets supérieurs (chaque côté)
Ground Pressure: Pression au sol (ISO 16754)
Drawbar Pull: Effort de traction à la barre d'attelage
Ripper Penetration: Profondeur de pénétration de la défonceuse
Ripper Lift Height: Hauteur de relevage de la défonceuse
Net Power: Puissance nette au volant
Gross Power: Puissance brute (ISO 14396)
Engine Power: Puissance nominale
-120 mm: Alésage [Moteur]; Course [Moteur]; Epaisseur de la tuile; Epaisseur de la lame
-0.4 m³: Réservoir de carburant; Réservoir hydraulique; Circuit de refroidissement
-24 MPa: Pression de direction; Pression de gavage; Pression de translation; Pression de freinage
-6 km/h: 2e vitesse; 1re vitesse avant; 1re arrière; 2e arrière
-2500 kg: Poids du ripper; Poids du treuil; Poids du contrepoids; Poids de la défonceuse
-1000 mm: Hauteur du crochet d'attelage; Largeur du ripper; Hauteur de la barre d'attelage; Espacement des dents
-2600 mm: Hauteur du capot; Hauteur à l'échappement; Largeur de la poutre de ripper; Hauteur sans cabine
-5000 mm: Longueur avec ripper; Longueur avec treuil; Rayon de braquage; Longueur hors tout avec lame et ripper
-90 kN: Force de pénétration; Force d'arrachement; Force d'arrachement du ripper; Force de pénétration du ripper
-25 °: Pente franchissable; Angle de pente; Angle de la dent; Dévers admissible
@grader
Blade Lift Cylinder Stroke: Course des vérins de levage de lame
Articulation Cylinder Stroke: Course des vérins d'articulation
Side Shift Cylinder Stroke: Course du vérin de déport latéral de la lame
Operating Weight: Poids en ordre de marche standard
Main Relief Pressure: Pression maximale du système
Main Pump Flow: Débit de la pompe
Maximum Travel Speed: Vitesse maximale en marche avant
Maximum Reverse Speed: Vitesse maximale en marche arrière
Steering Angle: Angle de braquage des roues avant
Articulation Angle: Angle d'articulation gauche/droite
Front Axle Oscillation: Oscillation totale de l'essieu avant
Turning Radius: Rayon de braquage (extérieur des pneus avant)
Wheel Lean Angle: Angle d'inclinaison des roues avant
Moldboard Length: Longueur de la lame standard
Moldboard Height: Hauteur de la lame
Moldboard Thickness: Épaisseur de la lame
Moldboard Arc Radius: Rayon de courbure de la lame
Throat Clearance: Dégagement entre lame et couronne
Circle Rotation: Angle de rotation de la couronne
Circle Diameter: Diamètre du cercle porte-lame
Blade Lift Above Ground: Élévation maximale au-dessus du sol
Depth of Cut: Profondeur de pénétration de la lame
Blade Side Shift Left: Déplacement latéral de la lame à gauche
Blade Side Shift Right: Déplacement latéral de la lame à droite
Shoulder Reach: Portée maximale à l'accotement à l'extérieur des pneus
Bank Cut Angle: Angle de dressage de talus
Blade Tip Angle Forward: Inclinaison de la lame vers l'avant
Blade Tip Angle Backward: Inclinaison de la lame vers l'arrière
Blade Pull: Effort de traction à la lame
Blade Down Pressure: Force d'appui maximale de la lame
Height to Top of Cylinders: Hauteur au sommet des vérins
Front Axle Height: Hauteur au centre de l'essieu avant
Tandem Axle Spacing: Distance entre essieux tandem
Front Axle to Articulation: Essieu avant au pivot d'articulation
Rear Axle to Articulation: Centre du tandem à l'articulation
Front Axle to Moldboard: Distance entre l'essieu avant et la lame
Tire Centerline Width: Largeur entre axes des pneus
Overall Height: Hauteur au sommet de la cabine
Overall Width: Largeur extérieure des pneus avant
Overall Length: Longueur de la machine de base
Ground Clearance: Garde au sol au pont arrière
Wheelbase: Empattement (essieu avant - centre tandem)
Ripper Penetration: Profondeur de pénétration du ripper
Engine Power: Puissance moteur
-120 mm: Alésage [Moteur]; Course [Moteur]; Epaisseur du tranchant
-0.4 m³: Réservoir de carburant; Réservoir hydraulique
-20 km/h: 5e rapport; 4e avant; 3e vitesse arrière; Vitesse en 4e
-4500 kg: Poids sur essieu avant; Poids sur essieu arrière; Poids avant; Poids sur roues avant
-300 mm: Largeur du tranchant; Profondeur de scarification; Espacement des dents; Profondeur du scarificateur
-2500 mm: Largeur de la lame frontale; Largeur de scarification; Largeur du scarificateur; Hauteur à l'échappement
-20 °: Oscillation du tandem; Pente franchissable; Débattement du tandem; Oscillation de l'essieu arrière
-80 kN: Force de pénétration du ripper; Force d'arrachement du ripper; Force d'arrachement
-9500 mm: Longueur avec ripper; Longueur avec lame frontale; Longueur avec ripper et lame avant
@forklift
Lift Cylinder Stroke: Course des vérins de levage
Free Lift Cylinder Stroke: Vérin de levée libre, course
Tilt Cylinder Stroke: Vérins d'inclinaison du mât, course
Steering Cylinder Stroke: Vérin de direction course
Main Relief Pressure: Pression de service levage
Main Pump Flow: Débit de la pompe
Rated Capacity: Capacité nominale / charge nominale
Load Center: Distance du centre de gravité de la charge (c)
Load Distance: Distance de la charge, axe de l'essieu moteur à la fourche
Operating Weight: Poids propre (batterie incluse)
Axle Load Front Laden: Charge sur l'essieu avec charge, avant
Axle Load Front Unladen: Charge sur l'essieu sans charge, avant
Mast Tilt Forward: Inclinaison du mât/tablier porte-fourches, avant
Mast Tilt Backward: Inclinaison du mât/tablier porte-fourches arrière
Lowered Mast Height: Hauteur hors tout du mât abaissé
Free Lift Height: Hauteur de levée libre
Lift Height: Hauteur de levée des fourches
Extended Mast Height: Hauteur hors tout du mât déployé
Overhead Guard Height: Hauteur au-dessus du protège-conducteur
Seat Height: Hauteur du siège conducteur
Coupling Height: Hauteur du crochet de remorquage
Length to Fork Face: Longueur jusqu'à la face avant des fourches
Overall Length: Longueur totale fourches comprises
Overall Width: Largeur de châssis hors tout
Wheelbase: Empattement (y)
Ground Clearance: Garde au sol au milieu de l'empattement m2
Turning Radius: Rayon de braquage extérieur
Front Tread: Écartement des roues avant
Rear Tread: Écartement des roues arrière
Ground Clearance Below Mast: Garde au sol avec charge sous le mât
Fork Length: Longueur des bras de fourche
Fork Width: Largeur d'un bras de fourche
Fork Thickness: Épaisseur des bras de fourche
Fork Carriage Width: Largeur du tablier porte-fourches
Aisle Width: Largeur d'allée avec palettes de 1000 x 1200 de travers
Travel Speed Laden: Vitesse de translation avec charge
Travel Speed Unladen: Vitesse de translation sans charge
Lift Speed Laden: Vitesse d'élévation, avec charge
Lift Speed Unladen: Vitesse d'élévation, sans charge
Lowering Speed Laden: Vitesse d'abaissement avec charge
Lowering Speed Unladen: Vitesse d'abaissement sans charge
Drawbar Pull: Effort de traction maxi en charge
Net Power: Puissance du moteur selon ISO 1585
-12 kW: Moteur de traction; Moteur de levage; Moteur de traction S2 60 min; Moteur de levage S3 15 %
-1500 kg: Charge par essieu en charge arrière; Charge par essieu à vide arrière; Poids du mât; Poids des fourches
-1500 mm: Largeur intérieure; Écartement extérieur des fourches; Écartement des fourches; Longueur batterie
-3200 mm: Largeur d'allée avec palette 800x1200 en long; Largeur d'allée avec palette 800 x 1200 longitudinale
-2 kN: Effort au crochet à vide; Effort de traction à vide; Effort au crochet sans charge
-0.3 m/s: Vitesse d'inclinaison; Vitesse de déport latéral
-14 MPa: Pression de service pour accessoires; Pression pour équipements; Pression de travail pour accessoires
-40 L/min: Débit d'huile pour accessoires; Débit pour accessoires
-100 mm: Alésage [Moteur]; Course [Moteur]; Course moteur
@mobile_crane
Luffing Cylinder Stroke: Course du vérin de levage de flèche
Luffing Cylinder Bore: Vérin de relevage, alésage
Telescoping Cylinder Stroke: Vérin de télescopage, course
Outrigger Jack Cylinder Stroke: Course des vérins de stabilisateurs
Main Relief Pressure: Pression maximale de service
Main Pump Flow: Débit de la pompe
Maximum Lifting Capacity: Charge maximale d'utilisation
Radius at Maximum Capacity: Portée à la capacité maximale
Maximum Working Radius: Portée maximale de travail
Boom Length Retracted: Longueur minimale de la flèche
Boom Length Extended: Longueur de la flèche principale
Boom Sections: Nombre de sections télescopiques
Boom Telescoping Time: Temps de télescopage de la flèche
Boom Luffing Time: Durée de relevage de la flèche
Boom Angle Maximum: Inclinaison maxi de la flèche
Boom Angle Minimum: Angle de relevage minimal
Jib Length: Longueur de la fléchette pliante
Jib Offset Angle: Angle d'inclinaison de la fléchette
Maximum Tip Height: Hauteur maximale sous crochet
Slewing Speed: Vitesse de rotation de la tourelle
Main Winch Line Speed: Vitesse du câble du treuil principal
Main Winch Line Pull: Effort de traction treuil principal
Hoist Rope Diameter: Diamètre du câble treuil principal
Outrigger Spread Lateral: Écartement transversal des stabilisateurs
Outrigger Spread Longitudinal: Écartement longitudinal des stabilisateurs
Counterweight: Poids du contrepoids
Tail Swing Radius: Rayon de giration du contrepoids
Operating Weight: Poids en configuration route
Axle Load: Charge maximale par essieu
Maximum Travel Speed: Vitesse maximale sur route
Overall Length: Longueur en ordre de route
Overall Width: Largeur du véhicule
Overall Height: Hauteur en ordre de route
Ground Clearance: Garde au sol minimale
Turning Radius: Rayon de braquage extérieur
Approach Angle: Angle d'approche avant
Departure Angle: Angle de départ arrière
Engine Power: Puissance moteur porteur
-200 kW: Puissance moteur grue; Puissance moteur tourelle; Puissance du moteur de la grue
-12000 kg: Capacité de la moufle; Capacité avec fléchette; Charge remorquable; Poids de la fléchette
-120 m/min: Vitesse de câble treuil auxiliaire; Vitesse treuil 2; Treuil auxiliaire
-60 kN: Effort au brin treuil auxiliaire; Charge de rupture du câble; Force de rupture; Réaction au sol
-210 mm: Alésage [Moteur]; Course [Moteur]; Diamètre du tambour; Diamètre des patins
-4500 mm: Empattement; Largeur de calage réduite; Voie; Largeur de calage stabilisateurs mi-sortis
-20 °: Pente franchissable; Angle de braquage; Angle mini de fléchette
-25 m: Longueur du câble; Longueur de câble; Longueur du câble de levage
-60 s: Temps de calage; Rétraction de la flèche; Descente de flèche; Temps de rentrée de flèche
-24 MPa: Pression de freinage; Pression de direction; Pression d'orientation; Pression de pilotage
-200 L/min: Débit orientation; Débit pompe de direction; Débit circuit d'orientation
@rigid_dump_truck
Hoist Cylinder Stroke: Course des vérins de levage de benne
Steering Cylinder Stroke: Vérins de direction, course
Main Relief Pressure: Pression de service du système de bennage
Main Pump Flow: Débit de la pompe de bennage
Rated Payload: Charge utile nominale maximale
Empty Weight: Poids en ordre de marche à vide
Gross Weight: Poids brut nominal de la machine
Body Capacity Heaped: Capacité de la benne à refus
Body Capacity Struck: Capacité de la benne à ras
Body Dump Angle: Angle de basculement de la benne
Body Raise Time: Temps de levage de la benne en charge
Body Lower Time: Temps d'abaissement de la benne
Body Weight: Poids de la benne standard
Chassis Weight: Châssis avec système de bennage
Maximum Travel Speed: Vitesse de déplacement max.
Steering Angle: Angle de braquage des roues
Turning Radius: Rayon de braquage à l'axe des pneus avant
Overall Length: Longueur hors tout
Overall Width: Largeur hors tout des pneus arrière
Overall Height: Hauteur jusqu'au sommet du ROPS
Wheelbase: Entraxe des essieux
Front Tread: Voie axe des pneus avant
Rear Tread: Entraxe des roues jumelées arrière
Body Raised Height: Hauteur hors tout, benne relevée
Loading Height: Hauteur de chargement de la benne
Dump Clearance: Garde au sol de la benne en position levée
Body Length Inside: Longueur intérieure de la benne
Body Width Inside: Largeur intérieure de la benne
Body Width Outside: Largeur extérieure de la benne
Body Depth Inside: Profondeur intérieure maximale de la benne
Rear Overhang: Axe de l'essieu arrière à l'extrémité arrière
Operating Width: Largeur hors tout avec rétroviseurs
Canopy Width: Largeur de la casquette de protection
Front Canopy Height: Hauteur au sommet de la casquette
Body Length Overall: Longueur hors tout de la benne
Rear Axle Clearance: Garde au sol sous l'essieu arrière
Engine Guard Clearance: Garde au sol sous la plaque de protection du moteur
Engine Power: Puissance nominale
Net Power: Puissance nette au volant
Gross Power: Puissance brute SAE J1995
-159 mm: Alésage [Moteur]; Course [Moteur]; Profondeur de sculpture; Diamètre du disque
-0.7 m³: Réservoir de carburant; Réservoir hydraulique; Circuit de refroidissement; Carter moteur
-21 MPa: Pression de direction; Pression de freinage; Pression de pilotage; Pression du circuit de direction
-300 L/min: Débit direction; Débit refroidissement des freins; Débit de la pompe de direction
-20 km/h: 1re vitesse; 3e rapport; Vitesse en 3e
-40000 kg: Poids sur essieu avant à vide; Poids sur essieu arrière en charge; Répartition avant
-3500 mm: Diamètre de braquage; Largeur cabine; Porte-à-faux avant; Hauteur garde-corps
-600 mm: Débattement de suspension; Course de suspension avant; Course de la suspension arrière
-400 kN: Effort de traction; Force de freinage; Effort à la jante
-25 °: Pente du fond de benne; Pente franchissable; Angle d'oscillation
-25 kW: Puissance du ventilateur; Alternateur; Puissance du ralentisseur
@articulated_dump_truck
Hoist Cylinder Stroke: Course des vérins de benne
Steering Cylinder Stroke: Vérins de direction, course
Main Relief Pressure: Pression de service du circuit de bennage
Main Pump Flow: Débit de la pompe
Rated Payload: Capacité de charge utile
Empty Weight: Poids en ordre de marche à vide
Gross Weight: Poids opérationnel en charge
Body Capacity Heaped: Capacité de la benne à refus
Body Capacity Struck: Capacité de la benne à ras
Body Capacity Heaped with Tailgate: Capacité de benne à refus avec hayon
Body Capacity Struck with Tailgate: Capacité de benne à ras avec hayon
Body Dump Angle: Angle de levage de benne
Body Raise Time: Temps de levage en charge
Body Lower Time: Abaissement de la benne
Articulation Angle: Angle d'articulation de chaque côté
Turning Radius: Rayon de braquage hors pneus
Overall Length: Longueur hors tout
Overall Width: Largeur hors pneus
Overall Height: Hauteur au sommet de la cabine
Body Raised Height: Hauteur hors tout benne levée
Loading Height: Hauteur de chargement de la benne
Dump Clearance: Hauteur de déversement benne levée
Body Length Inside: Longueur intérieure de la benne
Body Width Inside: Largeur intérieure de la benne
Body Width Outside: Largeur extérieure de la benne
Body Depth Inside: Profondeur intérieure maxi de la benne
Rear Overhang: De l'essieu arrière à l'arrière de la benne
Front Axle to Bogie: Essieu avant à l'essieu intermédiaire
Bogie Axle Spacing: Essieu intermédiaire à l'essieu arrière
Front Tread: Voie essieu avant
Rear Tread: Voie des roues arrière
Ground Clearance: Garde au sol à l'articulation
Front Overhang: De l'essieu avant à l'avant de la machine
Approach Angle: Angle d'attaque avant
Engine Power: Puissance moteur
-130 mm: Alésage [Moteur]; Course [Moteur]
-0.4 m³: Réservoir de carburant; Réservoir hydraulique
-20 MPa: Pression de direction; Pression de freinage; Pression du circuit de direction
-200 L/min: Débit direction; Débit pompe de direction; Débit de direction
-15 km/h: 2e vitesse; 3e rapport
-15000 kg: Essieu avant à vide; Essieu arrière en charge; Poids sur essieu avant; Charge sur essieu arrière
-3000 mm: Rayon de braquage intérieur; Rayon intérieur; Hauteur du capot; Largeur du hayon
-35 °: Angle de départ; Angle de fuite; Pente franchissable; Oscillation du châssis
-25 kW: Puissance du ventilateur; Puissance du ralentisseur; Alternateur
"""
BY_TYPE = {part.partition("\n")[0]: part.splitlines()[1:] for part in LABELS.split("@") if part}


@pytest.mark.parametrize("equipment_type", BY_TYPE)
def test_labels_are_taken_for_what_they_mean(equipment_type: str) -> None:
    lines = (line.partition(": ") for line in BY_TYPE[equipment_type])
    rows = [(head.removeprefix("-"), label, "") for head, _, labels in lines for label in labels.split("; ")]
    assert misread(equipment_type, rows) == []
